#include "harness/record/machine.h"

#include <fstream>
#include <string>
#include <thread>

#include <sys/utsname.h>

namespace towbench::harness {
namespace {

std::string processor() {
  std::ifstream stream("/proc/cpuinfo");
  std::string line;
  while (std::getline(stream, line)) {
    // "model name" on x86, "Model" on ARM boards.
    if (line.starts_with("model name") || line.starts_with("Model")) {
      const auto colon = line.find(": ");
      return colon == std::string::npos ? line : line.substr(colon + 2);
    }
  }
  return "unknown";
}

}  // namespace

nlohmann::json describe_machine() {
  utsname names{};
  uname(&names);
  return {{"system", std::string(names.sysname) + " " + names.release},
          {"architecture", names.machine},
          {"processor", processor()},
          {"cores", std::thread::hardware_concurrency()},
          {"compiler", __VERSION__}};
}

}  // namespace towbench::harness
