// Any text as a fixture and as a table: it is read or refused on one line, and nothing else
// happens.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "harness/experiment/experiment_fixture.h"
#include "harness/experiment/reference_table.h"

namespace {

using namespace towbench::harness;

template <typename Read>
void read_or_refuse(Read read) {
  try {
    read();
  } catch (const FixtureError& error) {
    if (std::strchr(error.what(), '\n') != nullptr || std::strlen(error.what()) == 0) {
      std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  read_or_refuse([&] {
    const auto file = FixtureFile::parse(text, "fuzz.toml");
    read_or_refuse([&] { (void)read_plant(file); });
    read_or_refuse([&] { (void)read_controller(file); });
    read_or_refuse([&] { (void)read_experiment(file); });
  });
  read_or_refuse([&] { (void)ReferenceTable::parse(text, "fuzz.csv"); });
  return 0;
}
