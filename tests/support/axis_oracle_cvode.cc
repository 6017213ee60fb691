// SUNDIALS CVODE (BDF, dense Newton, its own root finder) under the oracle's equations: a second
// integrator and a second event locator to check the first against.
#include <stdexcept>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "tests/support/axis_oracle.h"

namespace towbench::tests {
namespace {

using State = AxisOracle::State;

State read(N_Vector v) {
  State y{};
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] = NV_DATA_S(v)[i];
  }
  return y;
}

void write(const State& y, N_Vector v) {
  for (std::size_t i = 0; i < y.size(); ++i) {
    NV_DATA_S(v)[i] = y[i];
  }
}

int rates(realtype /*t*/, N_Vector y, N_Vector rate, void* oracle) {
  State raw{};
  static_cast<const AxisOracle*>(oracle)->derivative(read(y), raw);
  write(raw, rate);
  return 0;
}

int roots(realtype /*t*/, N_Vector y, realtype* out, void* oracle) {
  const auto margins = static_cast<const AxisOracle*>(oracle)->margins(read(y));
  for (std::size_t i = 0; i < margins.size(); ++i) {
    out[i] = margins[i] > 1e9 ? 1.0 : margins[i];
  }
  return 0;
}

void demand(int flag) {
  if (flag < 0) {
    throw std::runtime_error("CVODE failed with " + std::to_string(flag));
  }
}

}  // namespace

void AxisOracle::advance_by_cvode(const Input& input, double duration_s) {
  begin(input);
  SUNContext context = nullptr;
  demand(SUNContext_Create(nullptr, &context));
  constexpr sunindextype kSize = 7;
  N_Vector y = N_VNew_Serial(kSize, context);
  N_Vector absolute = N_VNew_Serial(kSize, context);
  const State size{1, 1, 100, 100, 1, 0.1, 1};
  for (std::size_t i = 0; i < size.size(); ++i) {
    NV_DATA_S(absolute)[i] = tolerance_ * size[i];
  }
  SUNMatrix jacobian = SUNDenseMatrix(kSize, kSize, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, jacobian, context);
  double now_s = 0;
  while (now_s < duration_s) {
    write(y_, y);
    void* memory = CVodeCreate(CV_BDF, context);
    demand(CVodeInit(memory, rates, now_s, y));
    demand(CVodeSVtolerances(memory, tolerance_, absolute));
    demand(CVodeSetUserData(memory, this));
    demand(CVodeSetLinearSolver(memory, solver, jacobian));
    demand(CVodeRootInit(memory, static_cast<int>(kMargins), roots));
    std::array<int, kMargins> falling{};
    falling.fill(-1);
    demand(CVodeSetRootDirection(memory, falling.data()));
    demand(CVodeSetNoInactiveRootWarn(memory));
    demand(CVodeSetStopTime(memory, duration_s));
    demand(CVodeSetMaxStep(memory, 1e-4));
    demand(CVodeSetMaxNumSteps(memory, 10'000'000));
    realtype reached_s = now_s;
    const int flag = CVode(memory, duration_s, y, &reached_s, CV_NORMAL);
    demand(flag);
    y_ = read(y);
    now_s = reached_s;
    if (flag == CV_ROOT_RETURN) {
      std::array<int, kMargins> which{};
      demand(CVodeGetRootInfo(memory, which.data()));
      for (std::size_t i = 0; i < kMargins; ++i) {
        if (which[i] != 0) {
          handle(i);
          break;
        }
      }
    }
    CVodeFree(&memory);
  }
  SUNLinSolFree(solver);
  SUNMatDestroy(jacobian);
  N_VDestroy(absolute);
  N_VDestroy(y);
  SUNContext_Free(&context);
}

}  // namespace towbench::tests
