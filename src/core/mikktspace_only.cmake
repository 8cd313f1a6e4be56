# The sources of the core with TSPACE_MIKKTSPACE_ONLY; scripts/amalgamate reads this list too. CMake compiles those
# without loops over a mesh for size (-Os).
set(tspace_mikktspace_loops
    base/weld.cpp tangents/mikktspace/node_sums.cpp tangents/mikktspace/one_pass.cpp tangents/mikktspace/small_mesh.cpp
    tangents/mikktspace/weld.cpp)
set(tspace_mikktspace_others
    base/border.cpp base/parallel.cpp base/range_lists.cpp simd/dispatch.cpp frames/face_cutter.cpp tangents/tangents.cpp
    tangents/mikktspace/evaluate.cpp tangents/mikktspace/grid_order.cpp tangents/mikktspace/groups.cpp
    tangents/mikktspace/last_bucket.cpp tangents/mikktspace/plan.cpp tangents/mikktspace/small_bucket.cpp
    tangents/mikktspace/welded_mesh.cpp c_api/c_convert.cpp c_api/c_tangents.cpp c_api/mikktspace.cpp)
