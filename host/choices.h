/* What settings choose from: each value's word on the command line, in statistics and messages, its identifier in C,
 * and, for what the core links by name, its object.
 *
 * A value's number is its place in the table: the core's enumerator, and what stands in a .gno file. So a table only
 * grows at its end.
 */
#ifndef CHOICES_H
#define CHOICES_H

#include "gnomon.h"

typedef struct choice {
    const char *word;
    const char *identifier; /* as an initialiser in a C header */
    const void *object;     /* of what the core links by name; 0: what it does where none is named */
} choice;

typedef struct choices {
    const choice *all;
    int count;
} choices;

enum { CHOICES_MOST = 12 }; /* no table is longer: choices.c does not compile otherwise */

extern const choices choices_shadow, choices_cull, choices_layers, choices_surface, choices_bias_unit;
extern const choices choices_receiver, choices_reconstruction, choices_fit, choices_warp, choices_faces;

/* The number of the object, which must be one of them. */
int choices_number(const choices *of, const void *object);

/* Is settings->slope of use: for the virtual surface, for the receiver, or for both? */
int choices_use_slope(const gn_settings *settings);

/* Does the light pass make a silhouette map, or one of crossings? Shadow volumes, which have no map at all, say nothing
 * of one. */
int choices_have_silhouettes(const gn_settings *settings);

/* Is the map fitted or warped to what the camera sees, in a view pass before the light pass? */
int choices_use_view(const gn_settings *settings);

/* Is it one map of a point light at a time, of which none stays? */
int choices_have_one_face(const gn_settings *settings);

enum { PARAMETERISATION_SIZE = 40 };

/* What --parameterise takes for the settings: uniform, a fit, a warp, or the two with + between them. */
void choices_parameterisation(const gn_settings *settings, char words[PARAMETERISATION_SIZE]);

/* Are meshes to have their edges: for shadow volumes, or for silhouettes? */
int choices_use_edges(const gn_settings *settings);

#endif
