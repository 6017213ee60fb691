// The composition root of the experiments that estimate.
#include <array>

#include <malloc.h>

#include "harness/commands/command.h"
#include "study/commands/verbs.h"

namespace {

// Columns of a whole log are made and dropped thousands of times. Given back to the system and
// fetched anew each time, their pages cost a sixth of a diagnosis.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest that glibc takes
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 64 << 20);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace towbench;
  using namespace towbench::study;
  keep_freed_memory();
  // `emulate` is the other process of a tow over a carrier.
  constexpr std::array<harness::AddVerb, 6> kVerbs{
      add_identify, add_tow, add_results, add_diagnose, add_validate_all, harness::add_emulate};
  return harness::run_command_line(kVerbs, argc, argv);
}
