// The composition root of the panel.
#include <array>

#include "harness/commands/command.h"
#include "harness/panel/panel_command.h"

int main(int argc, char** argv) {
  using namespace towbench::harness;
  // The other process of a run by the wall clock is this program again.
  constexpr std::array<AddVerb, 2> kVerbs{add_panel, add_emulate};
  return run_command_line(kVerbs, argc, argv);
}
