// Any message to the panel and any request target: carried out or refused in a sentence, and no
// file outside the runs' folder is ever named.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "harness/panel/steering.h"
#include "harness/panel/web_routes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench::harness;
  const std::string text(reinterpret_cast<const char*>(data), size);
  static Session session("runs-of-the-fuzzer");
  static WebKeys keys;
  static const std::string cookie = "towbench=" + keys.exchange(keys.ticket());
  static WebRoutes routes("/usr/share/doc", {"host"}, keys);
  if (text.find("start") == std::string::npos && steer(session, text).empty()) {
    std::abort();  // no run is under way: nothing can be carried out
  }
  const auto answer = routes.answer(
      {.method = "GET", .target = "/runs/" + text, .host = "host", .origin = "", .cookie = cookie});
  if (answer.file && !answer.file->string().starts_with("/usr/share/doc/")) {
    std::abort();
  }
  return 0;
}
