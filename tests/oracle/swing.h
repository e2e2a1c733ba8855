/* Views from around a scene, rolled. */
#ifndef GNOMON_TESTS_SWING_H
#define GNOMON_TESTS_SWING_H

#include <math.h>
#include <string.h>

#include "../host/scene/scene.h"

static inline void multiply(double out[3][3], double a[3][3], double b[3][3])
{
    double r[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) r[i][k] = a[i][0] * b[0][k] + a[i][1] * b[1][k] + a[i][2] * b[2][k];
    memcpy(out, r, sizeof r);
}

/* View n >= 1: the scene's camera swung round the point it looks at, and rolled. */
static inline void swing(scene *s, int n, const scene_camera *original)
{
    double yaw = 0.9 * sin(2.4 * n), roll = 0.8 * sin(1.7 * n + 0.5), distance = s->shadow.max_distance * 0.5;
    double turn[3][3] = {{cos(yaw), 0, sin(yaw)}, {0, 1, 0}, {-sin(yaw), 0, cos(yaw)}};
    double tilt[3][3] = {{cos(roll), -sin(roll), 0}, {sin(roll), cos(roll), 0}, {0, 0, 1}}, m[3][3];
    s->camera = *original;
    double target[3], back[3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) m[i][k] = original->to_world.m[i][k];
        target[i] = original->to_world.m[i][3] - distance * m[i][2];
    }
    multiply(m, turn, m);
    for (int i = 0; i < 3; i++) back[i] = m[i][2];
    multiply(m, m, tilt);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) s->camera.to_world.m[i][k] = m[i][k];
        s->camera.to_world.m[i][3] = target[i] + distance * back[i];
    }
}

#endif
