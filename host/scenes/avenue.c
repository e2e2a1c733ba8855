#include "scenes.h"
int avenue_write(FILE *file){(void)file;return 0;}
