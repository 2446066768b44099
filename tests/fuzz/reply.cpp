// Any bytes as what a reader of mesh files says of a scene: refused as nonsense, or a scene that is built and rendered.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "apps/formats/scene_blocks.h"
#include "core/base/expect.h"
#include "core/scene/texture.h"
#include "tests/fuzz/bytes.h"
#include "tests/fuzz/small_picture.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

namespace {

using apps::Saying;

core::Texture small_texture() {
  core::Texture texture{.name = "t", .levels = {{2, 2, {0x102030, 0xffffff, 0, 0x808080}}}};
  core::add_levels(texture);
  return texture;
}

/// So little room is made for what is announced that what comes outgrows it, too; and the sanitizer has a shadow to write of all
/// room that is made, which for a gigabyte takes longer than all else that is tried here.
constexpr apps::ReceivingLimits limits{.believed_bytes = 256, .expanded_bytes = std::uint64_t{1} << 20U};

/// Messages of a kind, a length, and as many bytes.
std::optional<core::Scene> received(tests::Bytes& bytes) {
  constexpr auto first = static_cast<std::size_t>(Saying::scene), last = static_cast<std::size_t>(Saying::vertices);
  apps::SceneReceiver receiver(limits);
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
  } catch (const core::CapacityError&) {  // more instances than fit
    return std::nullopt;
  }
}

}  // namespace

void try_reply(const std::uint8_t* data, std::size_t size) {
  tests::Bytes bytes(data, size);
  const std::optional<core::Scene> scene = received(bytes);
  covered().count("nonsense", !scene);
  covered().count("rendered", scene.has_value());
  if (scene) {
    tests::check_scene(*scene);
    tests::render_small(*scene);
  }
}

}  // namespace dmpc::fuzz
