// Any text as a fault on the command line: it is read, and then reads back as the same from words
// and from TOML, or it is refused on one line.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/fixture_error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench::harness;
  const std::string_view words(reinterpret_cast<const char*>(data), size);
  try {
    const auto fault = parse_fault(words);
    const auto text = describe(fault);
    const auto plan =
        read_fault_plan(FixtureFile::parse("schema = 1\n" + to_toml(fault), "plan.toml"));
    if (describe(parse_fault(text)) != text || describe(plan.at(0)) != text) {
      std::abort();
    }
  } catch (const FixtureError& error) {
    if (std::strchr(error.what(), '\n') != nullptr || std::strlen(error.what()) == 0) {
      std::abort();
    }
  }
  return 0;
}
