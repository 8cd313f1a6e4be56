# Checks that the page PAGE contains the complete file SOURCE, unchanged, as a code block of LANGUAGE.
file(READ "${PAGE}" page)
file(READ "${SOURCE}" code)
string(FIND "${page}" "```${LANGUAGE}\n${code}```" position)
if(position EQUAL -1)
    message(FATAL_ERROR "${PAGE} does not show ${SOURCE} as it is")
endif()
