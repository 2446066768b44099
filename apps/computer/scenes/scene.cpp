// Implements <dmpc/scene.h> with the ray tracer in core.
#include "apps/computer/dmpc/scene.h"

#include <bit>
#include <memory>
#include <new>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/machine/machines.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/database/database.h"
#include "core/families/scenes.h"
#include "core/picture/camera/background.h"
#include "core/picture/film/film.h"
#include "core/picture/pixel_task.h"
#include "core/record/records.h"
#include "core/trace/charge.h"
#include "nodes/charge.h"
#include "svm/pages/page.h"

namespace dmpc {
namespace {

using core::Charge;

constexpr std::array<Charge, scene_operation_count> scene_charges = {
    Charge::ray_setup,   Charge::cell_step, Charge::bvh_node_read, Charge::triangle_test,
    Charge::sphere_test, Charge::cone_test, Charge::shading,       Charge::tile_read};

static_assert(overread_bytes == core::overread_bytes);

/// The interface through which the tracer accesses pages.
struct RecordsOf {
  Pages& pages;
  const std::byte* find(core::Address address) { return pages.find(core::byte_offset(address)); }
};
static_assert(core::Records<RecordsOf>);

core::Scene scene_of(const std::string& name) {
  try {
    return core::built_in_scene(core::parse_scene_name(name));
  } catch (const core::InputError& error) {
    throw UsageError(error.what());
  }
}

core::RenderSettings settings_of(const core::Scene& scene, const core::Database& database, int width, int height) {
  const core::Camera camera(scene.view, database.header().frame, width, height, 1);
  return {.header = database.header(),
          .camera = camera,
          .shade = {},
          .refinement = {},
          .skips = {},
          .background = core::find_background(database, camera)};
}

}  // namespace

struct Scene::Data {
  core::Database database;
  core::RenderSettings settings;
};

Scene::Scene(const std::string& name, std::uint32_t width, std::uint32_t height, std::size_t page_bytes) {
  if (!svm::is_page_size(page_bytes) || width < 1 || height < 1 || width > 65536 || height > 65536) {
    throw UsageError("pages of " + std::to_string(page_bytes) + " bytes, " + std::to_string(width) + "x" +
                     std::to_string(height) +
                     " pixels: expected a power of two from 512 B to 64 KiB, and 1 to 65536 pixels a side");
  }
  const core::Scene scene = scene_of(name);
  core::Database database = core::build_database(scene, {.page_size_bytes = page_bytes});
  const core::RenderSettings settings = settings_of(scene, database, static_cast<int>(width), static_cast<int>(height));
  data_ = std::make_shared<const Data>(Data{std::move(database), settings});
}

std::uint32_t Scene::pixel_count() const { return data_->settings.camera.pixel_count(); }
std::size_t Scene::page_bytes() const { return data_->database.page_size(); }
std::uint32_t Scene::page_count() const { return static_cast<std::uint32_t>(data_->database.page_count()); }
std::span<const std::byte> Scene::records() const { return data_->database.bytes(); }

std::vector<OperationNeed> scene_operations() {
  const auto prices_ps = apps::operation_costs_ps(1);
  std::vector<OperationNeed> operations;
  for (const Charge charge : scene_charges) {
    const auto index = static_cast<std::size_t>(charge);
    operations.push_back({std::string(core::charge_names[index]), static_cast<double>(prices_ps[index]) / 1000});
  }
  return operations;
}

struct PixelTask::State {
  core::PixelTask task;
  core::Operations operations;
  nodes::Charges charged;

  /// Charges the operations since the last call.
  void charge(Pages& pages) {
    const nodes::Charges all{core::charges_of(operations)};
    for (Index i = 0; i < scene_charges.size(); ++i) {
      const std::uint64_t count = all[scene_charges[i]] - charged[scene_charges[i]];
      if (count > 0) {
        pages.charge(i, count);
      }
    }
    charged = all;
  }
};

namespace {

std::size_t stack_bytes_of(const Scene& scene) {
  return static_cast<std::size_t>(scene.data().settings.shade.depth_max) * sizeof(core::HitState);
}

/// Returns memory with the alignment of a node's memory.
std::shared_ptr<std::byte[]> aligned_bytes(std::size_t bytes) {
  constexpr std::align_val_t alignment{64};
  return {static_cast<std::byte*>(::operator new(bytes, alignment)),
          [](std::byte* place) { ::operator delete(place, alignment); }};
}

}  // namespace

std::size_t PixelTask::memory_bytes(const Scene& scene) {
  return core::round_up(stack_bytes_of(scene), alignof(State)) + sizeof(State);
}

PixelTask::PixelTask(const Scene& scene, std::span<std::byte> memory) : scene_(&scene) {
  static_assert(alignof(State) <= 64 && alignof(core::HitState) <= 64);
  core::expect(memory.size() >= memory_bytes(scene), "a pixel has the memory that it asks for");
  auto* const stack = reinterpret_cast<core::HitState*>(memory.data());
  const auto depth = static_cast<std::size_t>(scene.data().settings.shade.depth_max);
  std::uninitialized_default_construct_n(stack, depth);
  state_ = new (memory.data() + core::round_up(stack_bytes_of(scene), alignof(State)))
      State{core::PixelTask(std::span(stack, depth)), {}, {}};
}

PixelTask::PixelTask(const Scene& scene) : PixelTask(scene, aligned_bytes(memory_bytes(scene))) {}

PixelTask::PixelTask(const Scene& scene, std::shared_ptr<std::byte[]> memory)
    : PixelTask(scene, std::span(memory.get(), memory_bytes(scene))) {
  own_ = std::move(memory);
}

void PixelTask::start(std::uint32_t pixel) {
  const core::RenderSettings& settings = scene_->data().settings;
  core::expect(pixel < scene_->pixel_count(), "a pixel is one of the picture");
  state_->task.start(pixel, settings.first_samples(), settings, state_->operations);
}

Step PixelTask::run(Pages& pages) {
  const core::RenderSettings& settings = scene_->data().settings;
  RecordsOf records{pages};
  core::GridTracer tracer(records, settings.header, settings.skips);
  const core::TaskState state = state_->task.run(tracer, settings, state_->operations);
  state_->charge(pages);
  return state == core::TaskState::finished ? Step::finished : state == core::TaskState::more ? Step::more : Step::absent;
}

Light PixelTask::light() const { return std::bit_cast<Light>(state_->task.sums()); }

struct Picture::Film {
  core::Film film;
};

Picture::Picture(const Scene& scene)
    : film_(
          std::make_unique<Film>(Film{core::Film(scene.data().settings.camera.width(), scene.data().settings.camera.height())})) {
}
Picture::~Picture() = default;

void Picture::put(std::uint32_t pixel, const Light& light) { film_->film.deposit(pixel, std::bit_cast<core::PixelSums>(light)); }

std::string Picture::hash() const { return apps::hash_text(film_->film.hash()); }

}  // namespace dmpc
