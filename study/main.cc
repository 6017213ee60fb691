// The composition root of the experiments that estimate.
#include <array>

#include "harness/commands/command.h"
#include "study/commands/verbs.h"

int main(int argc, char** argv) {
  using namespace towbench::harness;
  // `emulate` is the other process of a tow over a carrier.
  constexpr std::array<AddVerb, 6> kVerbs{add_identify, add_tow,          add_results,
                                          add_diagnose, add_validate_all, add_emulate};
  return run_command_line(kVerbs, argc, argv);
}
