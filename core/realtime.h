// Marks a function that may run between sample-in and duty-out, or inside the 10 kHz plant step.
//
// A function so marked is noexcept, takes no heap, no lock and makes no system call once set-up is
// over. The mark is for the reader and for tests: tests/support/allocation_guard.h aborts a test in
// which marked code allocates.
#pragma once

#define TOWBENCH_REALTIME [[gnu::hot]]
