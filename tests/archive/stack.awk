# The most stack each public function can need, from gcc's call graph (-fcallgraph-info=su), read from standard input.
# Prints
#
#     FUNCTION BYTES           each function whose name starts with gn_, and main
#     deepest BYTES FUNCTION
#     recursion FUNCTION       a function that can come back to itself
#     dynamic FUNCTION         its frame has no fixed size
#     indirect FUNCTION        calls through a pointer that comes from outside: what it calls is not in the sum
#     unreached FUNCTION       nothing calls it, neither by name nor, as far as is known here, through a pointer
#     stale CALLER CALLED      patterns of may_call that nothing matches
#     outside FUNCTION         called, but not in the core
#
# Pointers that one file of the core hands to another are named below. Any other can only point at the static functions
# of its file that nothing calls by name: they count as called. A function outside the core counts as OUTSIDE bytes; the
# deepest, division of 64 bits in libgcc, takes less.

BEGIN {
    OUTSIDE = 96
    # gn_receiver and gn_reconstruction (core/gn_cascade.h)
    may_call("^gn_(camera_region|point_pass)$", "^gn_cascade_row$|:shade_nearest$")
    may_call("^gn_colour_region_row$", "^gn_colour_(row|fractions)$")
    may_call("^gn_cascade_row$", ":(move|vote|resample)|^gn_(vote_around|settle)$")
    may_call(":resample|^gn_settle$", ":sample|^gn_sample_nearest$")
    # gn_drawing and gn_canvas (core/gn_drawing.h)
    may_call("^gn_make_plan$", "^gn_check_drawing$")
    may_call("^gn_(make_plan|init)$|/gn_plan.c:lay_out_head", "^gn_lay_out_drawn$")
    may_call("^gn_lay_out_light$", "_map.c:lay_out_light$|^gn_lay_out_drawing$")
    may_call("^gn_light_begin$", "_map.c:begin$|^gn_begin_drawing$")
    may_call("^gn_light_layers$", "_map.c:draw$")
    may_call("/gn_drawing.c:|^gn_draw_silhouette_edges$", "_map.c:draw_stroke$")
    # gn_parameterisation, gn_round, gn_fit, gn_warp and gn_fitting (core/gn_parameterisation.h)
    may_call("^gn_make_plan$", "/gn_view_pass.c:make_plan")
    may_call("^gn_(make_plan|init)$|/gn_plan.c:lay_out_head", "/gn_view_pass.c:lay_out_head")
    may_call("/gn_view_pass.c:|^gn_view_(begin|region|end|pass)$",
             "/gn_(fit|minimal_frustum|rectilinear|rectilinear_distance|nonorthogonal).c:(bounds_bytes|bytes|clear|add|merge|end)")
    may_call("/gn_view_pass.c:", "^gn_rectilinear_(bytes|sums)$|^gn_nonorthogonal_bytes$")
    may_call("/gn_view_pass.c:lay_out_head", "^gn_lay_out_(rectilinear|nonorthogonal)$|/gn_warped_vertices.c:lay_out")
    may_call("^gn_light_begin$", "/gn_view_pass.c:make_view")
    may_call("/gn_receiver_plane.c:make_plane|^gn_find_plane$", "/gn_fit_depth.c:make_clamped_plane")
    may_call("^gn_find_points$", "^gn_find_(place_on_plane|face_points)$|/gn_point_pass.c:find_points$")
    # gn_grid (core/gn_grid.h), and what is done with triangles beyond the planes
    may_call("/gn_light_pass.c:|^gn_(light_layers|nearest_row|draw_rows)$|/gn_fit_depth.c:insert$",
             "/gn_(grid|nonorthogonal).c:(walk|aim)$|/gn_warped_vertices.c:(walk_|aim)")
    may_call("/gn_light_pass.c:insert_clipped", "/gn_fit_depth.c:insert$")
    may_call("/gn_warped_vertices.c:walk", "/gn_warped_vertices.c:move_")
    may_call("^gn_cascade_row$", "/gn_(grid|nonorthogonal).c:(place|doubt)$")
    may_call("/gn_grid.c:sample$", "/gn_(quadrants|quadrants_smooth|crossings|box|jitter|bilinear).c:sample|^gn_sample_nearest$")
    # gn_unequal_cells (core/gn_unequal_cells.h)
    may_call("/gn_quadrants(_smooth)?.c:sample", "/gn_unequal_cells.c:find_quadrant$")
    may_call("/gn_segment.c:|^gn_(centre_before|segment_in_cell)$|_map.c:", "/gn_unequal_cells.c:(centre_before|find_ways)$")
    # gn_faces (core/gn_point_light.h)
    may_call("^gn_(make_plan|init)$|/gn_plan.c:lay_out_head", "/gn_point_(light|pass).c:lay_out")
    may_call("^gn_camera_begin$", "/gn_point_(light|pass).c:(begin|refuse)_camera")
    # gn_casters (core/gn_context.h)
    may_call("^gn_make_plan$", "/gn_static_casters.c:make_plan$")
    may_call("^gn_light_begin$", "/gn_static_casters.c:begin$")
    may_call("^gn_light_layers$", "/gn_static_casters.c:start$")
    may_call("^gn_nearest_row$", "/gn_static_casters.c:start_row$")
    may_call("/gn_point_light.c:has_casters|^gn_begin_face$", "/gn_static_casters.c:reach$")
    may_call("/gn_static_casters.c:reach$", "/gn_point_light.c:covers$")
}

# A pointer in functions whose names match the first pattern may mean any that matches the second.
function may_call(caller, called) {
    pointer_in[++rule_count] = caller
    pointer_to[rule_count] = called
}

# node: { title: "NAME" label: "..\nFILE..\nN bytes (static)" }
$1 == "node:" {
    name = quoted($0, "title: ")
    if (match($0, /[0-9]+ bytes \([a-z,]+/)) {
        text = substr($0, RSTART, RLENGTH)
        frame[name] = text + 0
        if (text !~ /\(static$/)
            print "dynamic", name
    }
}

# edge: { sourcename: "CALLER" targetname: "CALLED" .. }
$1 == "edge:" {
    caller = quoted($0, "sourcename: ")
    called = quoted($0, "targetname: ")
    if (!((caller, called) in edge)) {
        edge[caller, called] = 1
        calls[caller, ++call_count[caller]] = called
        has_caller[called] = 1
    }
}

function quoted(line, key,    rest) {
    rest = substr(line, index(line, key "\"") + length(key) + 1)
    return substr(rest, 1, index(rest, "\"") - 1)
}

function add_call(caller, called) {
    calls[caller, ++call_count[caller]] = called
    pointed_at[called] = 1
}

# Add what the rules say of a caller's pointers; returns whether there was a rule.
function follow_rules(caller,    rule, name, found) {
    for (rule = 1; rule <= rule_count; rule++) {
        if (caller !~ pointer_in[rule])
            continue
        for (name in frame) {
            if (name ~ pointer_to[rule]) {
                add_call(caller, name)
                used[rule] = 1
                found = 1
            }
        }
    }
    return found
}

# Add the static functions (FILE:NAME) of a caller's file that nothing calls by name.
function follow_file(caller,    file, name, found) {
    file = caller
    if (!sub(/:.*/, "", file))
        return 0
    for (name in frame) {
        if (index(name, file ":") == 1 && !(name in has_caller)) {
            add_call(caller, name)
            found = 1
        }
    }
    return found
}

function resolve_pointers(    caller, name, rule) {
    for (caller in frame)
        if (((caller, "__indirect_call") in edge) && !follow_rules(caller) && !follow_file(caller))
            print "indirect", caller
    for (name in frame)
        if (name ~ /:/ && !(name in has_caller) && !(name in pointed_at))
            print "unreached", name
    for (rule = 1; rule <= rule_count; rule++)
        if (!(rule in used))
            print "stale", pointer_in[rule], pointer_to[rule]
}

# Deepest stack of a function and all it calls.
function depth(name,    i, called, most, d) {
    if (name in known)
        return known[name]
    if (!(name in frame)) {
        if (name != "__indirect_call")
            print "outside", name
        return known[name] = OUTSIDE
    }
    if (name in open) {
        print "recursion", name
        return 0
    }
    open[name] = 1
    most = 0
    for (i = 1; i <= call_count[name]; i++) {
        called = calls[name, i]
        d = depth(called)
        if (d > most)
            most = d
    }
    delete open[name]
    return known[name] = frame[name] + most
}

END {
    resolve_pointers()
    for (name in frame) {
        bytes = depth(name)
        if (name ~ /^gn_/ || name == "main")
            print name, bytes
        if (bytes > deepest && name != "main") {
            deepest = bytes
            deepest_name = name
        }
    }
    print "deepest", deepest, deepest_name
}
