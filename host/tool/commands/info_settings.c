/* Which settings were set, and by whom: the preset first, then the file, then the command line. */
#include "info_settings.h"

#include <stdio.h>
#include <string.h>

#include "../../base/utf8.h"

typedef enum { BY_DEFAULT, BY_FILE, BY_COMMAND_LINE } author;

typedef struct {
    author by;
    const char *key, *value;
    size_t n_key;
} setting;

static const char *const author_names[] = {"default", "file", "command line"};
static const setting default_preset = {BY_DEFAULT, "preset", "balanced", sizeof "preset" - 1};

/* In the order in which they are applied, the default preset before all. */
static setting setting_at(const scene *s, const tool_options *o, size_t i)
{
    if (i == 0) return default_preset;
    if (i <= s->n_settings) {
        const scene_setting *of_file = &s->settings[i - 1];
        return (setting){BY_FILE, of_file->key, of_file->value, strlen(of_file->key)};
    }
    const char *text = o->sets[i - 1 - s->n_settings], *equals = strchr(text, '=');
    return (setting){BY_COMMAND_LINE, text, equals + 1, (size_t)(equals - text)};
}

static size_t count_settings(const scene *s, const tool_options *o)
{
    return 1 + s->n_settings + (size_t)o->n_sets;
}

static bool is_key(const setting *it, const char *key, size_t n_key)
{
    return it->n_key == n_key && memcmp(it->key, key, n_key) == 0;
}

/* Whether a later one sets the same; a preset sets all that belongs to it. */
static bool is_overruled(const scene *s, const tool_options *o, size_t i)
{
    const setting it = setting_at(s, o, i);
    char key[64];
    snprintf(key, sizeof key, "%.*s", (int)it.n_key, it.key);
    const bool of_preset = settings_of_preset(key);
    for (size_t k = i + 1; k < count_settings(s, o); k++) {
        const setting later = setting_at(s, o, k);
        if (is_key(&later, it.key, it.n_key) || (of_preset && is_key(&later, "preset", 6))) return true;
    }
    return false;
}

void info_settings_text(const scene *s, const tool_options *o)
{
    author last = BY_DEFAULT;
    printf("  settings:");
    const char *before = "";
    for (size_t i = 0; i < count_settings(s, o); i++) {
        const setting it = setting_at(s, o, i);
        const bool overruled = is_overruled(s, o, i);
        char text[200];
        if (i == 0 && overruled) continue; /* nobody set it */
        snprintf(text, sizeof text, "%.*s=%s", (int)it.n_key, it.key, it.value);
        utf8_clean(text);
        if (it.by != last) printf("%s %s:", before, author_names[it.by]);
        printf(" %s%s", text, it.by == BY_DEFAULT ? " (default)" : overruled ? " (overruled)" : "");
        last = it.by;
        before = ";";
    }
    printf("\n");
}

static void json_text(const char *name, const char *text)
{
    printf("\"%s\": ", name);
    tool_json_string(text);
}

void info_settings_json(const scene *s, const tool_options *o)
{
    printf(", \"settings\": [");
    for (size_t i = 0; i < count_settings(s, o); i++) {
        const setting it = setting_at(s, o, i);
        char key[64];
        snprintf(key, sizeof key, "%.*s", (int)it.n_key, it.key);
        printf("%s{", i ? ", " : "");
        json_text("key", key);
        printf(", ");
        json_text("value", it.value);
        printf(", \"by\": \"%s\", \"overruled\": %d}", author_names[it.by], is_overruled(s, o, i));
    }
    printf("]");
}
