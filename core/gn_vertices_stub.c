#include "gn_parameterisation.h"
const gn_warp gn_rectilinear_vertices = {0}, gn_nonorthogonal_vertices = {0};
