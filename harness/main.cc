// The composition root of the bench.
#include "harness/commands/command.h"

int main(int argc, char** argv) {
  return towbench::harness::run_command_line(argc, argv);
}
