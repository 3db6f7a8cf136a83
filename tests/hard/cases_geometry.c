#include "hard.h"
const hard_list geometry_cases = {0, 0};
