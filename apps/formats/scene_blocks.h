// A scene of polygons and patches as messages, and back: whoever receives it believes nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "apps/formats/indexed_vertices.h"
#include "apps/frontend/system/input_memory.h"
#include "apps/reader/line.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// So much room is made for each list that is announced, before it comes: addresses, until it does. What is more comes into lists
/// that are copied into longer ones, which takes twice the room.
inline constexpr std::uint64_t believed_bytes_max = std::uint64_t{1} << 30U;

/// How long lists come: in messages, or, where the other end is dmpc and the system lets it, straight from the memory of the
/// reader that it has started, which spares three copies of four.
enum class Handing : std::uint8_t { in_messages, from_memory };

/// Sends all but the textures, the name and the scene's own vertices, in place of which it sends `vertices`, and what stands in
/// several places, `instances`, once with these; what is sent is freed on the way. Returns whether the other end took it.
bool send_scene(core::Scene& scene, IndexedVertices& vertices, core::Instances& instances, Line& line, Handing handing);

/// How much room is made for what few bytes say.
struct ReceivingLimits {
  /// For each list, before it comes: believed_bytes_max, or less for who tries many scenes that announce much and send nothing.
  std::uint64_t believed_bytes = believed_bytes_max;
  std::uint64_t expanded_bytes = reader_memory_bytes_max();  ///< for the scene with every instance that is copied
};

/// Puts it together, with every instance expanded, or with copies of base meshes left out. Throws Nonsense for what no scene may
/// hold: more than was announced; an index, a count, a kind or a number out of its range; a view that shows nothing;
/// core::CapacityError if the instances need more than there is; std::bad_alloc if memory ends.
class SceneReceiver {
 public:
  explicit SceneReceiver(const ReceivingLimits& limits = {}, core::Copies copies = core::Copies::put)
      : limits_(limits), copies_(copies) {}

  /// Whether the message is one of a scene's, and was taken.
  bool take(const Message& message);
  /// Fills some room, and returns whether it could.
  using Fill = std::function<bool(std::span<std::byte>)>;
  /// Reads `bytes` of a list's entries from `fill`, piece by piece, as from a message of `saying`. Returns false, and keeps none
  /// of them, if `fill` does.
  bool take_from(Saying saying, std::uint64_t bytes, const Fill& fill);
  /// Throws Nonsense if there are too many.
  void add(core::Texture texture);

  /// The whole, which is left empty. Requires the last message.
  core::Scene finish();

 private:
  void take_head(Unpacker fields);
  void take_lights(Unpacker fields);

  template <class T>
  static bool append(std::vector<T>& pool, std::uint64_t announced, std::uint64_t bytes, const Fill& fill);
  bool append_vertices(std::uint64_t bytes, const Fill& fill);
  void check_objects() const;
  void check_object(const core::Object& object) const;
  void check_material(const core::Material& material) const;
  void check_facet_textures() const;
  void check_instances() const;
  void check_copies() const;
  void settle_instances();
  void drop_needless_alpha(core::Material& material) const;

  ReceivingLimits limits_;
  core::Copies copies_;
  core::Scene scene_;
  core::Instances instances_;
  std::vector<core::Vec3d> points_;            ///< the scene's vertices
  std::map<Saying, std::uint64_t> announced_;  ///< how many entries there will be of each list
  bool has_head_ = false;
};

}  // namespace dmpc::apps
