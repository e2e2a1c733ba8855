#pragma once
#include <stdint.h>
#include <stdio.h>
#include <string.h>

void setup(void);
void loop(void);
