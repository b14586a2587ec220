# The menu entry and the file types, as a desktop reads them: both are valid, and files of each kind
# get the type that the menu entry opens.
#
# SOURCE_DIR, WORK_DIR, VALIDATE (desktop-file-validate), UPDATE (update-mime-database), GIO

file(GLOB entry ${SOURCE_DIR}/app/install/*.desktop)
execute_process(COMMAND ${VALIDATE} ${entry} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE failed)
if(failed OR said)
    message(FATAL_ERROR "${entry}: ${said}")
endif()

file(REMOVE_RECURSE ${WORK_DIR})
file(COPY ${SOURCE_DIR}/app/install/ghostlight.xml DESTINATION ${WORK_DIR}/mime/packages)
execute_process(
    COMMAND ${UPDATE} -V ${WORK_DIR}/mime
    OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE failed
)
if(failed OR said MATCHES "[Ww]arning|[Ee]rror")
    message(FATAL_ERROR "app/install/ghostlight.xml: ${said}")
endif()

file(READ ${entry} text)
function(expect file type)
    execute_process(
        COMMAND ${CMAKE_COMMAND} -E env XDG_DATA_HOME=${WORK_DIR} ${GIO} info -a standard::content-type ${file}
        OUTPUT_VARIABLE said
        ERROR_QUIET
    )
    if(NOT said MATCHES "content-type: ${type}\n")
        message(SEND_ERROR "${file}: found ${said}, expected ${type}")
    endif()
    if(NOT text MATCHES "MimeType=[^\n]*${type};" AND NOT type STREQUAL "application/json")
        message(SEND_ERROR "the menu entry does not open ${type}")
    endif()
endfunction()
expect(${SOURCE_DIR}/lenses/tessar_brendel_100_f2.8.json "application/x-ghostlight-lens[+]json")
expect(${SOURCE_DIR}/tests/data/zmx/triplet.zmx application/x-zemax-lens)
expect(${SOURCE_DIR}/tests/data/zmx/triplet_utf16.zmx application/x-zemax-lens)
expect(${SOURCE_DIR}/tests/data/seq/triplet.seq application/x-codev-sequence)
file(GLOB oslo ${SOURCE_DIR}/tests/data/oslo/*.len)
foreach(file IN LISTS oslo)
    expect(${file} application/x-oslo-lens)
endforeach()
file(WRITE ${WORK_DIR}/other.json "{\"name\": \"no lens\"}\n")
expect(${WORK_DIR}/other.json application/json)
