/* Which settings were set, and by whom. */
#ifndef GNOMON_INFO_SETTINGS_H
#define GNOMON_INFO_SETTINGS_H

#include "../cli/tool.h"

void info_settings_text(const scene *s, const tool_options *o);
void info_settings_json(const scene *s, const tool_options *o); /* ", "settings": [...]" */

#endif
