/* What was chosen about shadows, as people and as programs read it. */
#ifndef SETTINGS_REPORT_H
#define SETTINGS_REPORT_H

#include "gnomon.h"
#include "json.h"

#include <stdio.h>

/* What a shadow map was made and read with, as the options that say the same: layers and culling as planned. scale: as
 * in packed_scene. Shadow volumes have nothing of it. */
void settings_report_text(FILE *stream, const gn_settings *settings, const gn_plan *plan, int scale);

/* The same as members of the innermost object, after the kind of shadow: "map", or "volumes" and nothing else. */
void settings_report_json(json *j, const gn_settings *settings, const gn_plan *plan, int scale);

#endif
