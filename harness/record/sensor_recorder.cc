#include "harness/record/sensor_recorder.h"

#include <string>

#include "harness/checks/sensor_files.h"

namespace towbench::harness {

SensorRecorder::SensorRecorder(const std::filesystem::path& folder,
                               const emulator::RigParameters& rig, BackgroundWriter& writer) {
  if (rig.force_sensor.fitted) {
    force_.emplace(folder / kForceFile, kForceHeader, writer);
  }
  for (const auto axis : core::kAllAxes) {
    if (rig.axes[axis].exists && rig.axes[axis].current_monitor.fitted) {
      currents_[axis].emplace(folder / current_file(axis), current_header(axis), writer);
    }
    if (rig.axes[axis].exists && rig.axes[axis].encoder.absolute) {
      absolutes_[axis].emplace(folder / absolute_file(axis), absolute_header(axis), writer);
    }
  }
  if (rig.camera.fitted) {
    WriteFrame write;
    std::string header = "time_s";
    for (const auto axis : core::kPlanarAxes) {
      write.exists[axis] = rig.axes[axis].exists;
      header += rig.axes[axis].exists ? "," + camera_column(axis) : "";
    }
    camera_.emplace(folder / kCameraFile, header, writer, write);
  }
}

void SensorRecorder::WriteForce::operator()(
    std::span<const protocol::ForceSample> samples) const noexcept {
  for (const auto& sample : samples) {
    csv->time(sample.time_ns);
    for (const auto* three : {&sample.force_N, &sample.torque_Nm}) {
      for (const float value : *three) {
        csv->number(value);
      }
    }
    csv->end_row();
  }
}

void SensorRecorder::WriteCurrent::operator()(
    std::span<const protocol::CurrentSample> samples) const noexcept {
  for (const auto& sample : samples) {
    csv->time(sample.time_ns).number(sample.armature_current_A).end_row();
  }
}

void SensorRecorder::WriteAbsolute::operator()(
    std::span<const protocol::AbsoluteCount> counts) const noexcept {
  for (const auto& count : counts) {
    csv->time(count.time_ns).number(count.count).end_row();
  }
}

void SensorRecorder::WriteFrame::operator()(
    std::span<const emulator::CameraFrame> frames) const noexcept {
  for (const auto& frame : frames) {
    csv->time(frame.arrived_ns);
    for (const auto axis : core::kPlanarAxes) {
      if (exists[axis]) {
        csv->number(frame.carriage_m[axis]);
      }
    }
    csv->end_row();
  }
}

void SensorRecorder::add(const protocol::ForceSample& sample) noexcept {
  if (force_) {
    force_->rows.add(sample);
  }
}

void SensorRecorder::add(const protocol::CurrentSample& sample) noexcept {
  if (auto& file = currents_[sample.axis]) {
    file->rows.add(sample);
  }
}

void SensorRecorder::add(const protocol::AbsoluteCount& count) noexcept {
  if (auto& file = absolutes_[count.axis]) {
    file->rows.add(count);
  }
}

void SensorRecorder::add(const emulator::CameraFrame& frame) noexcept {
  if (camera_) {
    camera_->rows.add(frame);
  }
}

void SensorRecorder::hand_over() noexcept {
  if (camera_) {
    camera_->rows.hand_over();
  }
  if (force_) {
    force_->rows.hand_over();
  }
  for (auto& file : currents_) {
    if (file) {
      file->rows.hand_over();
    }
  }
  for (auto& file : absolutes_) {
    if (file) {
      file->rows.hand_over();
    }
  }
}

void SensorRecorder::flush() noexcept {
  if (camera_) {
    camera_->csv.flush();
  }
  if (force_) {
    force_->csv.flush();
  }
  for (auto& file : currents_) {
    if (file) {
      file->csv.flush();
    }
  }
  for (auto& file : absolutes_) {
    if (file) {
      file->csv.flush();
    }
  }
}

bool SensorRecorder::good() const noexcept {
  bool good = (!force_ || force_->csv.good()) && (!camera_ || camera_->csv.good());
  for (const auto& file : currents_) {
    good = good && (!file || file->csv.good());
  }
  for (const auto& file : absolutes_) {
    good = good && (!file || file->csv.good());
  }
  return good;
}

}  // namespace towbench::harness
