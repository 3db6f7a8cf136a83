#include "hard.h"
const hard_list number_cases = {0, 0};
