# Peers and oracles that tests use where they are installed, as imported targets, and which test needs which.

# GMP: the exact oracle of the robust predicates.
find_library(GMP_LIBRARY gmp)
find_path(GMP_INCLUDE_DIR gmp.h)
if(GMP_LIBRARY AND GMP_INCLUDE_DIR)
    add_library(talus_peer_gmp INTERFACE IMPORTED)
    target_link_libraries(talus_peer_gmp INTERFACE ${GMP_LIBRARY})
endif()
set(talus_test_predicates_needs talus_peer_gmp)

# Qhull: convex hulls to compare with.
find_library(QHULL_LIBRARY qhull_r)
find_path(QHULL_INCLUDE_DIR libqhull_r/qhull_ra.h)
if(QHULL_LIBRARY AND QHULL_INCLUDE_DIR)
    add_library(talus_peer_qhull INTERFACE IMPORTED)
    target_link_libraries(talus_peer_qhull INTERFACE ${QHULL_LIBRARY})
endif()

# xxHash: the oracle of the content hash.
find_library(XXHASH_LIBRARY xxhash)
find_path(XXHASH_INCLUDE_DIR xxhash.h)
if(XXHASH_LIBRARY AND XXHASH_INCLUDE_DIR)
    add_library(talus_peer_xxhash INTERFACE IMPORTED)
    target_link_libraries(talus_peer_xxhash INTERFACE ${XXHASH_LIBRARY})
endif()
set(talus_test_hash_needs talus_peer_xxhash)

# The io library's tests.
foreach(stem guarded_child import_process gltf_parser gltf_reader import_formats sibling_file atomic_write file_map format_float mesh_import name_table obj_reader obj_write parse_float
        point_cloud split_polygon contour_text polygon_levels area_marks)
    set(talus_test_${stem}_needs talus_io)
endforeach()

# The world library's tests.
foreach(stem triangle_record segment_file plan_file merge_tiles tile_times shard manifest)
    set(talus_test_${stem}_needs talus_world)
endforeach()

# The built-in levels of the command.
set(talus_test_sample_level_needs talus_sample)

# Parts of the command.
set(talus_test_thread_pool_needs talus_cli)
set(talus_test_draw_navmesh_needs talus_cli talus_sample)

set(talus_test_ray_decide_needs talus_peer_gmp)
foreach(stem frame options examples manual bake areas around audit prune ray soup_queries path hull polygonize draw detour bad_input
        links outputs baked_options walkable precision axes streams path_costs view hand_links world ranks routes crowd)
    set(talus_test_cli_${stem}_needs talus_command_path)
endforeach()
# The module for mpirun, with its mpirun.
if(TARGET talus_mpi AND MPIEXEC_EXECUTABLE)
    add_library(talus_mpirun_path INTERFACE)
    target_compile_definitions(talus_mpirun_path INTERFACE TALUS_MPIRUN="${MPIEXEC_EXECUTABLE}")
    list(APPEND talus_test_cli_ranks_libraries talus_mpirun_path)
endif()
set(talus_test_hull_qhull_needs talus_peer_qhull)

# Recast: the navmesh pipeline to compare with.
include(${PROJECT_SOURCE_DIR}/cmake/TalusPeerRecast.cmake)
set(talus_test_nav_recast_needs talus_peer_recast talus_sample talus_io)

# Detour: the queries to compare with.
include(${PROJECT_SOURCE_DIR}/cmake/TalusPeerDetour.cmake)
foreach(stem path_detour detour_exchange detour_off_mesh)
    set(talus_test_${stem}_needs talus_peer_detour talus_sample talus_io)
endforeach()

# Exact paths on real levels.
set(talus_test_shortest_path_needs talus_io)
set(talus_test_wide_bakes_needs talus_io talus_sample)
set(talus_test_prepared_walls_needs talus_sample)
set(talus_test_character_walks_needs talus_sample)
set(talus_test_character_paths_needs talus_sample)
set(talus_test_packed_floors_needs talus_sample)
foreach(stem stacked_tiles tile_divide)
    set(talus_test_${stem}_needs talus_sample)
endforeach()

# The whole pipeline over the built-in levels and real ones.
set(talus_test_settings_sweep_needs talus_sample talus_io)
set(talus_test_nav_links_proof_needs talus_sample talus_io)
foreach(stem why_points audit_mutations)
    set(talus_test_${stem}_needs talus_sample talus_io)
endforeach()

# The same bytes from any order, thread count and compiler.
set(talus_test_nav_golden_needs talus_sample talus_io)

# Bullet and libccd: convex pairs to compare with, in one table.
include(${PROJECT_SOURCE_DIR}/cmake/TalusPeerConvex.cmake)
set(talus_test_convex_families_libraries talus_peer_convex)
# The floors of a built-in level.
set(talus_test_open_floors_needs talus_sample)
