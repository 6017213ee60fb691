// Pages and pictures of docs/ that are measured, each printed by one function.
#pragma once

namespace towbench::tests {

void print_tracking();
void print_observers();
// docs/measurements/tracking-summary.md.
void print_results();
// docs/measurements/control-rate.md.
void print_rates();
// The estimators' errors against truth as a table, and as a picture.
void print_velocity_table();
void print_velocity_picture();

}  // namespace towbench::tests
