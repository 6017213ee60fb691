// The composition root of the panel.
#include <array>

#include "harness/commands/command.h"

int main(int argc, char** argv) {
  using namespace towbench::harness;
  constexpr std::array<AddVerb, 1> kVerbs{add_panel};
  return run_command_line(kVerbs, argc, argv);
}
