// Whose turn it is when both processors are taken: who only looks on never displaces the bench.
//
// A browser on the same processors is not ours to hold back. It was given the bench's processor
// some 150 times a second, for a twentieth of the run's time; so the run goes ahead of everybody
// where the host allows it (root, CAP_SYS_NICE, or `nice` in limits.conf).
#pragma once

namespace towbench::harness {

// This thread waits for a free turn (SCHED_BATCH: waking up does not take the processor from one
// that runs), and so do the threads that it starts, until they call take_turns().
void look_on() noexcept;

// This thread is one that works (SCHED_OTHER), and so are the threads that it starts, ahead of
// other programs (nice -10) where that is allowed.
void take_turns() noexcept;

}  // namespace towbench::harness
