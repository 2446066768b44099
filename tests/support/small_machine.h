// The tests' little language for svm's node programs: a node alone, and pages without a scene. A whole computer in any legal
// order is in shuffled_machine.h.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "core/picture/pixel_task.h"
#include "nodes/node.h"
#include "nodes/program.h"
#include "svm/host.h"
#include "svm/pages/node_program.h"
#include "svm/plan.h"
#include "svm/program.h"
#include "tests/support/shuffled_machine.h"

namespace dmpc::tests {

template <class T>
Parcel parcel_of(std::uint32_t source, svm::Kind kind, const T& value) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(&value, 1));
  return {nodes::NodeId{source}, nodes::NodeId{}, svm::number_of(kind), {bytes.begin(), bytes.end()}};
}

/// Node `index` of a plan, without a thread, and what it sends.
struct LoneNode : SingleNode {
  LoneNode(const svm::Plan& plan, std::uint32_t index, nodes::Immutable immutable = nodes::Immutable::is_copied)
      : SingleNode(index == plan.node_count() ? plan.host_memory() : plan.node_memory(index), index, plan.node_count() + 1,
                   immutable) {}
};

/// Pages full of numbers that depend on their place, and the overread behind them.
struct FakePages {
  FakePages(std::uint32_t page_count, std::size_t page_size_bytes)
      : page_size(page_size_bytes), storage(page_count * page_size_bytes / 8 + core::overread_bytes / 8) {
    for (std::size_t i = 0; i < storage.size(); ++i) {
      storage[i] = core::mix(i + 1);
    }
  }
  std::span<const std::byte> bytes() const {
    return std::as_bytes(std::span(storage)).first(storage.size() * 8 - core::overread_bytes);
  }
  std::span<const std::byte> page(std::size_t index) const { return bytes().subspan(index * page_size, page_size); }

  std::size_t page_size;
  std::vector<std::uint64_t> storage;
};

/// Reads the records of a database of a known size.
template <class Records>
struct FakeTracer {
  Records* records;
  std::uint64_t record_count;  ///< records of 8 bytes
};

/// In place of core::PixelTask: a walk through the pages in which each number says where the next is read. Some rays of some
/// steps.
class FakeTask {
 public:
  static constexpr std::uint32_t pixels_max = 1;
  using Hits = core::HitState;

  explicit FakeTask(std::span<core::HitState>) {}

  void start(std::span<const std::uint32_t> pixels, std::span<const core::SampleStep>, const core::RenderSettings&,
             core::Operations& operations) {
    pixel_ = pixels.front();
    state_ = core::mix(pixel_);
    rays_left_ = static_cast<std::uint32_t>(state_ % 4) + 1;
    begin_ray(operations);
  }

  template <class Records>
  core::TaskState run(FakeTracer<Records>& tracer, const core::RenderSettings&, core::Operations& operations) {
    if (steps_left_ == 0) {
      if (rays_left_ == 0) {
        return core::TaskState::finished;
      }
      begin_ray(operations);
    }
    for (; steps_left_ > 0; --steps_left_) {
      absent_ = core::Address{static_cast<std::uint32_t>(state_ % tracer.record_count)};
      const std::byte* record = tracer.records->find(absent_);
      if (record == nullptr) {
        return core::TaskState::absent;
      }
      std::uint64_t word = 0;
      std::memcpy(&word, record, sizeof(word));
      state_ = core::mix(state_ ^ word);
    }
    return core::TaskState::more;
  }

  core::Address absent() const { return absent_; }
  std::uint32_t rays_ended() const { return 1; }
  std::uint32_t pixel_count() const { return 1; }
  std::uint32_t pixel(std::uint32_t = 0) const { return pixel_; }
  core::Ray ray() const { return {}; }
  core::PixelSums sums(std::uint32_t = 0) const {
    core::PixelSums sums;
    for (std::size_t i = 0; i < 6; ++i) {
      sums.plane[i / 3].channel[i % 3] = static_cast<std::int64_t>(core::mix(state_ + i) >> 2U);
    }
    return sums;
  }

 private:
  void begin_ray(core::Operations& operations) {
    ++operations.rays[0];
    --rays_left_;
    steps_left_ = static_cast<std::uint32_t>(core::mix(state_) % 6) + 1;
  }

  std::uint64_t state_ = 0;
  std::uint32_t pixel_ = 0, rays_left_ = 0, steps_left_ = 0;
  core::Address absent_ = core::no_address;
};
static_assert(sizeof(FakeTask) <= sizeof(core::PixelTask), "a plan for real tasks has room for these");

/// Settings for a picture of this size; what they show does not matter.
inline core::RenderSettings fake_settings(std::uint32_t width, std::uint32_t height) {
  core::DatabaseHeader header;
  return {header, core::Camera(core::View{}, header.frame, static_cast<int>(width), static_cast<int>(height), 1), {}};
}

/// The picture that every machine must produce: pixel after pixel from one array.
inline core::Film fake_reference(const FakePages& pages, const core::RenderSettings& settings) {
  core::Film film(settings.camera.width(), settings.camera.height());
  core::LocalRecords records(pages.bytes());
  FakeTracer<core::LocalRecords> tracer{&records, pages.bytes().size() / 8};
  core::Operations operations;
  for (std::uint32_t pixel = 0; pixel < settings.camera.pixel_count(); ++pixel) {
    FakeTask task({});
    task.start(std::span<const std::uint32_t>(&pixel, 1), std::array{core::SampleStep::first()}, settings, operations);
    while (task.run(tracer, settings, operations) != core::TaskState::finished) {
    }
    film.deposit(pixel, task.sums());
  }
  return film;
}

/// The node program over fake pages. `Records` is Pager, CountingPager or LocalCopy.
template <class Records>
std::unique_ptr<svm::NodeProgram> fake_program(nodes::Node& node, const svm::Plan& plan, const core::RenderSettings& settings,
                                               const FakePages& pages) {
  const auto make_tracer = [&](Records& records) { return FakeTracer<Records>{&records, pages.bytes().size() / 8}; };
  return std::make_unique<svm::ControlProgram<Records, FakeTracer<Records>, FakeTask>>(node, plan, settings, pages.bytes(),
                                                                                       make_tracer);
}

}  // namespace dmpc::tests
