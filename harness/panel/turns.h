// Whose turn it is when both processors are taken: who only observes never displaces the bench.
//
// A browser on the same processors is not ours to hold back. It was given the bench's processor
// for a twentieth of the run's time while the other one had turns to spare; so the run goes ahead
// of other programs where the host allows it (root, CAP_SYS_NICE, or `nice` in limits.conf), here
// thread by thread, and with all of its session in autogroup.h. docs/measurements/performance.md
// has what that gains, and why a real-time class gains nothing.
#pragma once

namespace towbench::harness {

constexpr int kAhead = -10;  // of a processor that one other wants too, nine tenths

// This thread waits for a free turn (SCHED_BATCH: waking up does not take the processor from one
// that runs), and so do the threads that it starts, until they call share_processor().
void observe_only() noexcept;

// This thread is one that works (SCHED_OTHER), and so are the threads that it starts, ahead of
// other programs (nice -10) where that is allowed.
void share_processor() noexcept;

}  // namespace towbench::harness
