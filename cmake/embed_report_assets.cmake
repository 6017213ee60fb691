# cmake -DHEADER=... -DNAMESPACE=... -DPAGE=... -DPAGE_FUNCTION=... -DSTYLE=... [-DSCRIPT=...] -DOUTPUT=...
#       -P embed_report_assets.cmake
#
# Writes the C++ file that defines the functions of HEADER: the page, style_asset and script_asset.
# Bytes, not a string literal: nothing in the files can then end or alter it.

function(append_asset function file)
  set(bytes "")
  set(digest "")
  if(file)
    file(READ ${file} hex HEX)
    file(SHA256 ${file} digest)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
    string(REGEX REPLACE "((.......)(.......)(.......)(.......)(.......)(.......)(.......)(.......))"
           "\\1\n" bytes "${bytes}")
  endif()
  # The closing zero keeps the array legal when there is no file; it is not part of the text.
  file(APPEND ${OUTPUT} "
Asset ${function}() {
  static constexpr char kBytes[] = {
${bytes}'\\0'};
  return {{kBytes, sizeof kBytes - 1}, \"${digest}\"};
}
")
endfunction()

file(WRITE ${OUTPUT} "// Generated from reports/ by cmake/embed_report_assets.cmake.
#include \"${HEADER}\"

namespace ${NAMESPACE} {
")
append_asset(${PAGE_FUNCTION} "${PAGE}")
append_asset(style_asset "${STYLE}")
append_asset(script_asset "${SCRIPT}")
file(APPEND ${OUTPUT} "
}  // namespace ${NAMESPACE}
")
