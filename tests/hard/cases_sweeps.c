#include "hard.h"
const hard_list sweep_cases = {0, 0};
