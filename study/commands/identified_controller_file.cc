#include "study/commands/identified_controller_file.h"

#include <cstdio>

#include "harness/fixtures/controller_fixture.h"
#include "harness/record/line_writer.h"

namespace towbench::study {

void write_identified_controller(const std::filesystem::path& path,
                                 const procedures::Machine& machine,
                                 const identify::Estimates& estimates) {
  const auto text = procedures::identified_controller(machine, estimates);
  if (text.empty()) {
    return;
  }
  try {
    (void)harness::read_controller(harness::FixtureFile::parse(text, path));
    harness::write_atomically(path, text);
  } catch (const harness::FixtureError& error) {
    std::fprintf(stderr, "not written: %s\n", error.what());
  }
}

}  // namespace towbench::study
