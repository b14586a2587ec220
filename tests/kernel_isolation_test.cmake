# A kernel is compiled for a newer instruction set than the rest of the program. If one of its
# objects holds a weak function with a name that is not its own, the linker may keep that copy for
# everybody, and the program dies on older machines. So every weak function in it must carry the
# namespace of the set, or, as std::experimental::simd's do, the machine's flags.
#
# cmake -DNM=... "-DOBJECTS=a.o;b.o" -P kernel_isolation_test.cmake

set(findings)
foreach(object IN LISTS OBJECTS)
    execute_process(COMMAND ${NM} -C --defined-only ${object} OUTPUT_VARIABLE symbols
                    COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE ";" "," symbols "${symbols}")
    string(REPLACE "\n" ";" symbols "${symbols}")
    foreach(symbol IN LISTS symbols)
        # "W" and "u": weak functions and unique globals. Weak objects ("V") hold no code.
        if(symbol MATCHES "^[0-9a-f]+ [Wu] (.*)$")
            set(function "${CMAKE_MATCH_1}")
            if(NOT function MATCHES "::v[34]::|_MachineFlagsTemplate")
                cmake_path(GET object FILENAME name)
                list(APPEND findings "${name}: ${function}")
            endif()
        endif()
    endforeach()
endforeach()

if(findings)
    list(JOIN findings "\n  " text)
    message(FATAL_ERROR "Functions compiled for a newer instruction set under a shared name:\n  ${text}")
endif()
