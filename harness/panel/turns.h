// Whose turn it is when both processors are taken: who only looks on never displaces the bench.
#pragma once

namespace towbench::harness {

// This thread waits for a free turn (SCHED_BATCH: waking up does not take the processor from one
// that runs), and so do the threads that it starts, until they call take_turns().
void look_on() noexcept;

// This thread is one that works (SCHED_OTHER).
void take_turns() noexcept;

}  // namespace towbench::harness
