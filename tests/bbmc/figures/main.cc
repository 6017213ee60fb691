// bbmc_figures PAGE: prints a measured page of docs/ to standard output.
#include <cstdio>
#include <string_view>

#include "tests/bbmc/figures/figures.h"
#include "tests/bbmc/support/typed_session.h"

int main(int argc, char** argv) {
  const std::string_view page = argc == 2 ? argv[1] : "";
  if (page == "tracking") {
    towbench::tests::print_tracking();
  } else if (page == "observers") {
    towbench::tests::print_observers();
  } else if (page == "results") {
    towbench::tests::print_results();
  } else if (page == "rates") {
    towbench::tests::print_rates();
  } else if (page == "session") {
    std::fputs(towbench::tests::typed_session().c_str(), stdout);
  } else if (page == "velocity") {
    towbench::tests::print_velocity_table();
  } else if (page == "velocity.svg") {
    towbench::tests::print_velocity_picture();
  } else {
    std::fputs(
        "usage: bbmc_figures tracking|observers|results|rates|session|velocity|velocity.svg\n",
        stderr);
    return 2;
  }
  return 0;
}
