// The composition root of the bench.
#include <array>

#include "harness/commands/command.h"

int main(int argc, char** argv) {
  using namespace towbench::harness;
  constexpr std::array kVerbs{add_demo,
                              add_run,
                              add_list,
                              add_validate,
                              add_emulate,
                              add_control,
                              add_replay,
                              add_report,
                              add_campaign,
                              add_falsify,
                              add_conform,
                              add_new_machine,
                              add_export_fmu,
                              add_panel_elsewhere,
                              add_doctor,
                              add_completion,
                              add_identify_elsewhere};
  return run_command_line(kVerbs, argc, argv);
}
