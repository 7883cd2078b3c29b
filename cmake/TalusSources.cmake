# Sources that stand in place of others.

# talus_choose_sources(LIST SUFFIX WANTED): where WANTED, name<SUFFIX>.c stands in place of name.c; else it is left out.
function(talus_choose_sources list suffix wanted)
    set(chosen ${${list}})
    foreach(source IN LISTS ${list})
        if(source MATCHES "${suffix}\\.c$")
            string(REGEX REPLACE "${suffix}\\.c$" ".c" plain "${source}")
            if(wanted)
                list(REMOVE_ITEM chosen "${plain}")
            else()
                list(REMOVE_ITEM chosen "${source}")
            endif()
        endif()
    endforeach()
    set(${list} ${chosen} PARENT_SCOPE)
endfunction()
