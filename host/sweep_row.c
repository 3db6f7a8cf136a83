#include "sweep_row.h"

#include "text.h"

#include <math.h>
#include <string.h>

#define AT(field) offsetof(sweep_row, field), sizeof(((sweep_row *)0)->field)

/* The order is that of CSV and JSON. */
const sweep_column sweep_columns[SWEEP_COLUMNS] = {
    {"scene", "", "name of the scene", SWEEP_TEXT, AT(scene)},
    {"chain", "", "name of the choices", SWEEP_TEXT, AT(chain)},
    {"options", "", "options of gnomon render that make this mask", SWEEP_TEXT, AT(options)},
    {"depth_bits", "bits", "of a stored depth", SWEEP_COUNT, AT(depth_bits)},
    {"map", "texels", "a side of the map; 0: none", SWEEP_COUNT, AT(map)},
    {"budget", "bytes", "that this map is the largest for; 0: a size that was asked for", SWEEP_COUNT, AT(budget)},
    {"bias", "texels", "the bias, where it is in texels", SWEEP_NUMBER, AT(bias)},
    {"false_shadow", "%", "lit in truth, shadowed here; of pixels that see a surface", SWEEP_NUMBER, AT(false_shadow)},
    {"false_light", "%", "shadowed in truth, lit here; of the same", SWEEP_NUMBER, AT(false_light)},
    {"error", "%", "false shadow and false light together", SWEEP_NUMBER, AT(error)},
    {"edge_band", "%", "of it within two pixels of a true shadow edge", SWEEP_NUMBER, AT(edge_band)},
    {"interior", "%", "of it farther away", SWEEP_NUMBER, AT(interior)},
    {"mean_absolute_error", "%", "of the lit fraction", SWEEP_NUMBER, AT(mean_absolute_error)},
    {"resident_bytes", "bytes", "map, silhouettes and warp tables, which stay between passes", SWEEP_COUNT,
     AT(resident_bytes)},
    {"peak_bytes", "bytes", "the whole block of memory", SWEEP_COUNT, AT(peak_bytes)},
    {"triangles", "", "set up in the light pass", SWEEP_COUNT, AT(triangles)},
    {"texels", "", "covered by them", SWEEP_COUNT, AT(texels)},
    {"pixels", "", "that see a surface", SWEEP_COUNT, AT(pixels)},
    {"tested", "", "of them: turned to the light", SWEEP_COUNT, AT(tested)},
    {"outside", "", "of the tested: outside of the map", SWEEP_COUNT, AT(outside)},
    {"agreed", "", "of the tested: all texels agreed", SWEEP_COUNT, AT(agreed)},
    {"virtual", "", "of the tested: decided by virtual samples", SWEEP_COUNT, AT(virtual_pixels)},
    {"fractional", "", "of the tested: partly lit", SWEEP_COUNT, AT(fractional)},
    {"silhouette", "", "of the tested: decided by silhouettes or crossings", SWEEP_COUNT, AT(silhouette)},
    {"p_percent", "%", "P: silhouette over pixels", SWEEP_NUMBER, AT(p_percent)},
    {"overdraw", "", "O: fragments of shadow volumes over fragments seen", SWEEP_NUMBER, AT(overdraw)},
    {"bandwidth", "", "bytes read a pixel over those of a shadow map, in the model of Sen et al.", SWEEP_NUMBER,
     AT(bandwidth)},
    {"multiplies", "", "operations of a frame", SWEEP_COUNT, AT(multiplies)},
    {"divides", "", "operations of a frame", SWEEP_COUNT, AT(divides)},
    {"adds", "", "operations of a frame", SWEEP_COUNT, AT(adds)},
    {"loads", "", "operations of a frame", SWEEP_COUNT, AT(loads)},
    {"stores", "", "operations of a frame", SWEEP_COUNT, AT(stores)},
    {"others", "", "operations of a frame", SWEEP_COUNT, AT(others)},
    {"m4_view", "instructions", "Cortex-M4, view pass, by the cost model", SWEEP_NUMBER, AT(m4_view)},
    {"m4_light", "instructions", "Cortex-M4, light pass, by the cost model", SWEEP_NUMBER, AT(m4_light)},
    {"m4_camera", "instructions", "Cortex-M4, camera pass, by the cost model", SWEEP_NUMBER, AT(m4_camera)},
    {"m4_pixel", "instructions", "Cortex-M4, all passes over the pixels that see a surface", SWEEP_NUMBER,
     AT(m4_pixel)},
    {"host_ratio", "", "time of a frame on this machine over that of the chain constant", SWEEP_NUMBER, AT(host_ratio)},
    {"key", "", "hash of what the row hangs on", SWEEP_TEXT, AT(key)},
};

static char *place(sweep_row *row, const sweep_column *column)
{
    return (char *)row + column->offset;
}

sweep_row sweep_row_empty(void)
{
    sweep_row row = {.scene = ""};
    const double unknown = NAN;
    for (int i = 0; i < SWEEP_COLUMNS; i++)
        if (sweep_columns[i].kind != SWEEP_TEXT)
            memcpy(place(&row, &sweep_columns[i]), &unknown, sizeof unknown);
    return row;
}

const char *sweep_row_text(const sweep_row *row, const sweep_column *column)
{
    return (const char *)row + column->offset;
}

double sweep_row_number(const sweep_row *row, const sweep_column *column)
{
    double number;
    memcpy(&number, (const char *)row + column->offset, sizeof number);
    return number;
}

int sweep_row_set(sweep_row *row, const sweep_column *column, const char *value)
{
    size_t length = strlen(value);
    double number = NAN;
    if (column->kind == SWEEP_TEXT) {
        if (length >= column->size)
            return 0;
        memcpy(place(row, column), value, length + 1);
        return 1;
    }
    if (length && word_number((word){value, length}, &number))
        return 0;
    memcpy(place(row, column), &number, sizeof number);
    return 1;
}

const sweep_column *sweep_column_find(const char *name, size_t length)
{
    for (int i = 0; i < SWEEP_COLUMNS; i++)
        if (strlen(sweep_columns[i].name) == length && memcmp(sweep_columns[i].name, name, length) == 0)
            return &sweep_columns[i];
    return 0;
}
