#include "hard.h"
const hard_list light_cases = {0, 0};
