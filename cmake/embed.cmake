# cmake -DINPUT=file -DOUTPUT=file.cpp -DNAME=function -DHEADER=header -DNAMESPACE=namespace -P embed.cmake
# Writes a C++ source with a function that returns the bytes of INPUT, declared by HEADER in NAMESPACE. An array of
# numbers, not a string literal: any byte is allowed and no compiler's limit on the length of literals matters.
file(READ "${INPUT}" hex HEX)
# CMake's regular expressions have no {n}; 32 dots cut the digits into lines of 16 bytes.
string(REPEAT "." 32 line)
string(REGEX REPLACE "(${line})" "\\1\n" hex "${hex}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," hex "${hex}")
get_filename_component(input_name "${INPUT}" NAME)
file(WRITE "${OUTPUT}.new"
"// Generated from ${input_name}; do not edit.
#include \"${HEADER}\"

namespace ${NAMESPACE} {
namespace {
// clang-format off
const unsigned char bytes[] = {
${hex}
0x00};  // keeps the array from being empty
// clang-format on
}  // namespace

std::string_view ${NAME}() { return {reinterpret_cast<const char*>(bytes), sizeof(bytes) - 1}; }

}  // namespace ${NAMESPACE}
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
