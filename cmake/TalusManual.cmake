# Lets the program PROGRAM write its manual pages and completion into FOLDER; COMMANDS are its commands. EMULATOR runs it,
# where it is another machine's. For cmake -P.
function(talus_write file)
    execute_process(COMMAND ${EMULATOR} ${PROGRAM} help ${ARGN} OUTPUT_FILE ${FOLDER}/${file} RESULT_VARIABLE code)
    if(code)
        message(FATAL_ERROR "${PROGRAM} help ${ARGN} ends with ${code}")
    endif()
endfunction()

talus_write(talus.1 --man)
foreach(name IN LISTS COMMANDS)
    talus_write(talus-${name}.1 --man ${name})
endforeach()
foreach(shell bash zsh fish)
    talus_write(talus.${shell} --completion ${shell})
endforeach()
