# What the steps of a frame with a fit or a warp cost, from callgrind's file with names in full; `name` begins the line.
# Million instructions:
#
#     seen      which triangle each pixel sees, once: what the papers call the G-buffer
#     again     the same for the rounds of the view pass, which keeps no G-buffer
#     fit       places on the light's plane, and their bounds or the smallest rectangle about them
#     warp      the same places for each round of the warp, counts, and tables
#     map       the light pass
#     test      places, the shadow test and the mask
#
# (with shadow volumes map: which edges are silhouettes; test: the volumes' sides)
# then the four last as shares of their sum in per cent, their sum, and the sum of all.
function calls(caller, callee) {
    return cost[caller ">" callee] / 1e6
}

/^fn=/ { caller = substr($0, 4) }
/^cfn=/ { callee = substr($0, 5) }
/^calls=/ {
    getline
    cost[caller ">" callee] += $2
    all[callee] += $2
}

END {
    seen = calls("gn_camera_region", "gn_rasterise_region") + all["gn_camera_begin"] / 1e6
    again = calls("gn_view_region", "gn_rasterise_region") + all["gn_view_begin"] / 1e6
    test = all["gn_camera_region"] / 1e6 - calls("gn_camera_region", "gn_rasterise_region")
    map = (all["gn_light_begin"] + all["gn_light_layers"] + all["gn_light_resolve"]) / 1e6
    if (all["gn_volumes_region"]) {
        seen = calls("gn_volumes_region", "gn_rasterise_region")
        test = all["gn_volumes_region"] / 1e6 - seen
        seen += all["gn_volumes_begin"] / 1e6
        map = all["gn_volumes_light"] / 1e6
    }
    view = all["gn_view_region"] / 1e6 - calls("gn_view_region", "gn_rasterise_region") + all["gn_view_end"] / 1e6
    if (fitted) {
        if (rounds > 1) {
            own = calls("gather_row", "add_bounds") + calls("gn_view_end", "end_bounds")
            others = calls("gather_row", "add") + calls("gather_row", "add_across") + calls("gather_row", "add_down")
            ends = all["gn_view_end"] / 1e6 - calls("gn_view_end", "end_bounds")
            fit = (view - own - others - ends) / rounds + own
        } else
            fit = view
    }
    warp = view - fit
    sum = fit + warp + map + test
    printf "| %s | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f | %.1f | %.1f | %.1f | %.1f | %.0f | %.0f |\n", name, seen, again, fit,
        warp, map, test, 100 * fit / sum, 100 * warp / sum, 100 * map / sum, 100 * test / sum, sum, sum + seen + again
}
