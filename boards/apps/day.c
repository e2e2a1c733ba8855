#include "day.h"

static int32_t two_digits(const char *text)
{
    int good = text[0] >= '0' && text[0] <= '9' && text[1] >= '0' && text[1] <= '9';
    return good ? (text[0] - '0') * 10 + text[1] - '0' : -1;
}

int32_t day_frame(const char **text)
{
    const char *t = *text;
    int32_t hour = two_digits(t), minute = hour < 0 || t[2] != ':' ? -1 : two_digits(t + 3);
    if (minute < 0 || minute > 59 || minute % DAY_MINUTES_PER_FRAME || hour < DAY_FIRST_HOUR) return -1;
    *text = t + 5;
    return (hour - DAY_FIRST_HOUR) * DAY_FRAMES_PER_HOUR + minute / DAY_MINUTES_PER_FRAME;
}

void day_text(uint32_t frame, char text[6])
{
    uint32_t hour = frame / DAY_FRAMES_PER_HOUR + DAY_FIRST_HOUR,
             minute = frame % DAY_FRAMES_PER_HOUR * DAY_MINUTES_PER_FRAME;
    text[0] = (char)('0' + hour / 10);
    text[1] = (char)('0' + hour % 10);
    text[2] = ':';
    text[3] = (char)('0' + minute / 10);
    text[4] = (char)('0' + minute % 10);
    text[5] = '\0';
}

/* A 128x64 picture of the whole garden has a dial of 45 x 30 pixels. */
const gn_scene *day_scene(scene_state *state, uint32_t frame)
{
    const gn_scene *scene = scene_frame(state, frame);
    state->scene.camera.focal_q24 = state->scene.camera.focal_q24 / 16 * SCREEN_ZOOM;
    return scene;
}
