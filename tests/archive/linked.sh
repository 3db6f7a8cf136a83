#!/bin/sh
# What is not used is not linked: functions that the programs of port/footprint/ hold, and do not hold.
. tests/tap.sh

# has PROGRAM NAME...
has() {
    program=$1
    shift
    for name; do
        arm-none-eabi-nm "$BUILD/cortex-m4-16/footprint/$program.elf" | grep -qw "$name" || {
            echo "$program does not hold $name"
            return 1
        }
    done
}

# lacks PROGRAM NAME...
lacks() {
    program=$1
    shift
    for name; do
        if has "$program" "$name" >/dev/null; then
            echo "$program holds $name"
            return 1
        fi
    done
}

cascade='gn_cascade_row gn_find_points'
planes='gn_find_plane gn_virtual gn_plane_bias'
filters='gn_colour_fractions gn_bilinear gn_jitter_4x4 gn_box_5x5'
# what core/gn_drawing.c, gn_segment.c and gn_silhouette.c bring, and the row of depths that only they ask for
drawing='gn_draw_silhouette_edges gn_check_drawing gn_lay_out_drawn gn_begin_canvas gn_settle gn_make_segment
    gn_find_facings gn_edge_winding gn_check_edges gn_half_edge_ends gn_nearest_row'
silhouettes="$drawing gn_silhouettes gn_draw_silhouettes gn_segment_rows gn_segment_columns gn_segment_in_cell"
crossings='gn_crossings gn_draw_crossings'
casters='gn_static_casters'
maps='gn_silhouette_map gn_crossing_map gn_silhouettes_smooth'

# Each name is held by some program, so that none is misspelt.
# shellcheck disable=SC2086 # words
{
    check "a program with points and the nearest texel alone holds the test of a row" has footprint gn_shade_row
    check "and no cascade, no planes, no filters, no silhouettes, no static casters" \
        lacks footprint $cascade $planes $filters $silhouettes $crossings $maps $casters
    check "one with static casters holds them" has footprint_static $casters
    check "and no cascade, no silhouettes, no point lights, no fits" lacks footprint_static $cascade $silhouettes \
        $crossings gn_begin_face gn_view_pass
    check "one with virtual samples holds cascade and planes" has footprint_virtual $cascade gn_find_plane gn_virtual
    check "and no filters, no silhouettes" lacks footprint_virtual $filters $silhouettes $crossings $maps
    check "one with silhouettes holds cascade, planes and silhouettes" \
        has footprint_silhouette $cascade gn_find_plane gn_virtual $silhouettes
    check "and no crossings, no filters, no shadow volumes" lacks footprint_silhouette $crossings $filters $maps \
        gn_volumes_pass gn_list_silhouettes
    check "one with crossings holds them" has footprint_crossing $cascade gn_virtual $drawing $crossings
    check "and no silhouette map, no filters, no shadow volumes" lacks footprint_crossing $filters $maps \
        gn_silhouettes gn_draw_silhouettes gn_segment_in_cell gn_volumes_pass gn_list_silhouettes
    check "one that asks for all of these and for their maps holds them" \
        has ../firmware $silhouettes $crossings $maps gn_volumes_pass gn_list_silhouettes
    check "one with a plane bias holds cascade and planes" has footprint_plane_bias $cascade gn_find_plane gn_plane_bias
    check "and neither virtual samples nor filters nor silhouettes" lacks footprint_plane_bias gn_virtual $filters $silhouettes $crossings
    for filter in bilinear:gn_bilinear jitter:gn_jitter_4x4 box:gn_box_5x5; do
        program=footprint_${filter%:*} name=${filter#*:}
        check "one with ${filter%:*} filter holds cascade and fractions" has $program $cascade gn_colour_fractions $name
        check "and no planes, no silhouettes" lacks $program $planes $silhouettes $crossings
        check "and no other filter" lacks $program $(echo "$filters" | sed "s/gn_colour_fractions//; s/$name//")
    done
    check "one with virtual samples and a filter holds both" \
        has footprint_virtual_box $cascade gn_find_plane gn_virtual gn_colour_fractions gn_box_5x5 gn_light_pass
    check "and no shadow volumes" lacks footprint_virtual_box gn_volumes_pass
    check "one with shadow volumes holds them" has footprint_volumes gn_volumes_pass
    check "and nothing of maps" lacks footprint_volumes gn_shade_row gn_light_pass $cascade $planes $filters \
        gn_silhouettes gn_draw_silhouettes gn_draw_silhouette_edges gn_make_segment gn_nearest_row $crossings $maps
}
finish
