#include "sweep_chains.h"

#include <stdio.h>
#include <string.h>

#define VIRTUAL .method = "mixed", .receiver = "virtual"

const sweep_chain sweep_chains[SWEEP_CHAINS] = {
    {.name = "constant", .method = "constant", .bias = "2t"},
    {.name = "constant-best", .method = "constant", .searches_bias = 1},
    {.name = "slope", .method = "slope"},
    {.name = "midpoint", .method = "midpoint"},
    {.name = "dual", .method = "dual"},
    {.name = "second-depth", .method = "second-depth"},
    {.name = "mixed", .method = "mixed"},
    {.name = "adaptive", .method = "adaptive"},
    {.name = "plane-bias", .method = "constant", .receiver = "plane-bias", .bias = "2t"},
    {.name = "second-depth+virtual", .method = "second-depth", .receiver = "virtual"},
    {.name = "mixed+virtual", VIRTUAL},
    {.name = "bilinear", VIRTUAL, .reconstruct = "bilinear"},
    {.name = "jitter4x4", VIRTUAL, .reconstruct = "jitter4x4"},
    {.name = "pcf5", VIRTUAL, .reconstruct = "pcf5"},
    {.name = "silhouette", .method = "silhouette"},
    {.name = "silhouette-smooth", .method = "silhouette", .reconstruct = "silhouette-smooth"},
    {.name = "crossing", .method = "silhouette", .reconstruct = "crossing"},
    {.name = "mixed+virtual/dv", VIRTUAL, .parameterise = "dv"},
    {.name = "mixed+virtual/msf", VIRTUAL, .parameterise = "msf"},
    {.name = "mixed+virtual/rectilinear", VIRTUAL, .parameterise = "rectilinear"},
    {.name = "mixed+virtual/dv+rectilinear-distance", VIRTUAL, .parameterise = "dv+rectilinear-distance"},
    {.name = "mixed+virtual/dv+rectilinear", VIRTUAL, .parameterise = "dv+rectilinear"},
    {.name = "mixed+virtual/msf+rectilinear", VIRTUAL, .parameterise = "msf+rectilinear"},
    {.name = "mixed+virtual/dv+nonorthogonal", VIRTUAL, .parameterise = "dv+nonorthogonal"},
    {.name = "silhouette/dv", .method = "silhouette", .parameterise = "dv"},
    {.name = "silhouette/msf", .method = "silhouette", .parameterise = "msf"},
    {.name = "silhouette/rectilinear", .method = "silhouette", .parameterise = "rectilinear"},
    {.name = "silhouette/dv+rectilinear-distance", .method = "silhouette", .parameterise = "dv+rectilinear-distance"},
    {.name = "silhouette/dv+rectilinear", .method = "silhouette", .parameterise = "dv+rectilinear"},
    {.name = "silhouette/msf+rectilinear", .method = "silhouette", .parameterise = "msf+rectilinear"},
    {.name = "crossing/msf+rectilinear",
     .method = "silhouette",
     .reconstruct = "crossing",
     .parameterise = "msf+rectilinear"},
    {.name = "volumes", .method = "volumes"},
};

const sweep_chain *sweep_chain_find(const char *name, size_t length)
{
    for (int i = 0; i < SWEEP_CHAINS; i++)
        if (strlen(sweep_chains[i].name) == length && memcmp(sweep_chains[i].name, name, length) == 0)
            return &sweep_chains[i];
    return 0;
}

int sweep_chain_has_map(const sweep_chain *chain)
{
    return strcmp(chain->method, "volumes") != 0;
}

const char *sweep_chain_refuses(const sweep_chain *chain, int light_kind)
{
    if (light_kind != GN_POINT)
        return 0;
    if (!sweep_chain_has_map(chain))
        return "shadow volumes take no point light";
    return chain->parameterise ? "fits and warps take no point light" : 0;
}

void sweep_choice_make(sweep_choice *choice, const sweep_chain *chain, unsigned map, const char *size, double bias)
{
    memset(choice, 0, sizeof *choice);
    choice->values[RENDER_METHOD] = chain->method;
    choice->values[RENDER_RECEIVER] = chain->receiver;
    choice->values[RENDER_RECONSTRUCT] = chain->reconstruct;
    choice->values[RENDER_PARAMETERISE] = chain->parameterise;
    choice->values[RENDER_BIAS] = chain->bias;
    if (chain->searches_bias) {
        snprintf(choice->bias, sizeof choice->bias, "%.5gt", bias);
        choice->values[RENDER_BIAS] = choice->bias;
    }
    if (sweep_chain_has_map(chain)) {
        snprintf(choice->map, sizeof choice->map, "%u", map);
        choice->values[RENDER_MAP] = choice->map;
    }
    if (size && *size) {
        snprintf(choice->size, sizeof choice->size, "%s", size);
        choice->values[RENDER_SIZE] = choice->size;
    }
}

void sweep_choice_text(const sweep_choice *choice, char *line, size_t room)
{
    static const option names[RENDER_OPTION_COUNT] = {RENDER_OPTIONS};
    size_t used = 0;
    line[0] = 0;
    for (int i = 0; i < RENDER_OPTION_COUNT; i++)
        if (choice->values[i] && used < room)
            used += (size_t)snprintf(line + used, room - used, "%s%s %s", used ? " " : "", names[i].name,
                                     choice->values[i]);
}
