# Detour as an imported target, beside Recast. For tests and benchmarks only.
include(${PROJECT_SOURCE_DIR}/cmake/TalusPeerRecast.cmake)
find_library(DETOUR_LIBRARY Detour)
if(TARGET talus_peer_recast AND DETOUR_LIBRARY AND NOT TARGET talus_peer_detour)
    add_library(talus_peer_detour INTERFACE IMPORTED)
    target_link_libraries(talus_peer_detour INTERFACE talus_peer_recast ${DETOUR_LIBRARY})
endif()
