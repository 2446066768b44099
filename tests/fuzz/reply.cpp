// Any bytes as what a reader of mesh files says of a scene: refused as nonsense, or a scene that is built and rendered.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "apps/reader/scene_blocks.h"
#include "core/camera.h"
#include "core/database.h"
#include "core/expect.h"
#include "core/render.h"
#include "core/texture.h"
#include "tests/fuzz/bytes.h"

using namespace dmpc;

namespace {

using apps::Saying;

/// More of them make an input slow and find nothing new.
constexpr std::size_t lights_max = 16, objects_max = 200;
constexpr int picture_side = 4, depth_max = 4;

core::Texture small_texture() {
  core::Texture texture{.name = "t", .levels = {{2, 2, {0x102030, 0xffffff, 0, 0x808080}}}};
  core::add_levels(texture);
  return texture;
}

/// A kind, a length, and so many bytes; again and again.
std::optional<core::Scene> received(tests::Bytes& bytes) {
  constexpr auto first = static_cast<std::size_t>(Saying::scene), last = static_cast<std::size_t>(Saying::corners);
  apps::SceneReceiver receiver;
  try {
    receiver.add(small_texture());
    while (!bytes.empty()) {
      apps::Message message;
      message.saying = static_cast<Saying>(first + bytes.below(last - first + 1));
      for (std::size_t left = bytes.word(); left > 0 && !bytes.empty(); --left) {
        message.bytes += static_cast<char>(bytes.byte());
      }
      core::expect(receiver.take(message), "what a scene is made of is taken");
    }
    return receiver.finish();
  } catch (const apps::Nonsense&) {
    return std::nullopt;
  } catch (const std::bad_alloc&) {  // more was announced than there is room for
    return std::nullopt;
  }
}

void check_promises(const core::Scene& scene) {
  using core::expect;
  for (const core::Object& object : scene.objects) {
    expect(object.kind <= core::ObjectKind::textured && object.material < scene.materials.size(), "an object is one");
    expect(object.first + std::uint64_t{object.vertex_count} <= scene.vertices.size(), "an object's vertices are there");
  }
  for (const core::Vec3d& vertex : scene.vertices) {
    expect(std::isfinite(vertex.x) && std::isfinite(vertex.y) && std::isfinite(vertex.z), "every vertex is somewhere");
  }
}

void render(const core::Scene& scene) {
  try {
    const core::Database database = core::build_database(scene, {});
    core::LocalRecords records(database.bytes());
    core::GridTracer tracer(records, database.header(), {});
    const core::Camera camera(scene.view, database.header().frame, picture_side, picture_side, 1);
    core::Operations operations;
    const core::Film film = core::render(tracer, {database.header(), camera, {.depth_max = depth_max}}, operations);
    core::expect(film.pixels().size() == picture_side * picture_side, "every pixel is there");
  } catch (const core::InputError&) {  // a scene without room, or too large to be reckoned with
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tests::Bytes bytes(data, size);
  const std::optional<core::Scene> scene = received(bytes);
  if (scene) {
    check_promises(*scene);
    if (scene->lights.size() <= lights_max && scene->objects.size() <= objects_max) {
      render(*scene);
    }
  }
  return 0;
}
