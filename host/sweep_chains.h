/* The chains that a sweep measures: which surface, receiver, reconstruction and parameterisation follow each other, as
 * the options of `gnomon render` say it.
 */
#ifndef SWEEP_CHAINS_H
#define SWEEP_CHAINS_H

#include "render_options.h"

typedef struct sweep_chain {
    const char *name;
    const char *method;
    const char *receiver, *reconstruct, *parameterise; /* 0: not given */
    const char *bias;                                  /* the same; where `searches_bias`, found by search */
    int searches_bias;
} sweep_chain;

enum { SWEEP_CHAINS = 32 };

/* Constant bias comes first: what the others are measured against. */
extern const sweep_chain sweep_chains[SWEEP_CHAINS];

/* 0: there is none of that name. */
const sweep_chain *sweep_chain_find(const char *name, size_t length);

/* Shadow volumes have none: neither sizes nor depths tell them apart. */
int sweep_chain_has_map(const sweep_chain *chain);

/* Why the chain takes no light of this kind (gn_light_kind); 0: it does. */
const char *sweep_chain_refuses(const sweep_chain *chain, int light_kind);

/* The values of RENDER_OPTIONS, and what they point to. */
typedef struct sweep_choice {
    const char *values[RENDER_OPTION_COUNT];
    char map[16], size[16], bias[24];
} sweep_choice;

/* size: of the image, as --size takes it; 0 or empty: the scene's. bias: texels, of chains that search it. The choice
 * stays where it is: it points into itself. */
void sweep_choice_make(sweep_choice *choice, const sweep_chain *chain, unsigned map, const char *size, double bias);

/* As they stand on a command line. */
void sweep_choice_text(const sweep_choice *choice, char *line, size_t room);

#endif
