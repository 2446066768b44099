// Sends a scene of polygons and patches as messages, and receives it; the receiver trusts nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "apps/formats/indexed_vertices.h"
#include "apps/frontend/system/available_memory.h"
#include "apps/reader/line.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Address space reserved for each announced list before its data arrive; memory is used as they do. Longer lists are copied as
/// they grow, which takes twice the memory.
inline constexpr std::uint64_t believed_bytes_max = std::uint64_t{1} << 30U;

/// Transport of lists: in messages, or, where the other end is dmpc and the system allows it, directly from the memory of the
/// reader process, which saves three copies of four.
enum class Handing : std::uint8_t { in_messages, from_memory };

/// Sends everything except the textures, the name and the scene's own vertices, in place of which it sends `vertices`, with
/// instanced meshes once and `instances`; sent data are freed on the way. Returns whether the other end received it.
bool send_scene(core::Scene& scene, IndexedVertices& vertices, core::Instances& instances, Line& line, Handing handing);

/// Limits of memory for a few received bytes.
struct ReceivingLimits {
  /// For each list, before it arrives: believed_bytes_max, or less for tests of many scenes that announce much and send nothing.
  std::uint64_t believed_bytes = believed_bytes_max;
  std::uint64_t expanded_bytes = reader_memory_bytes_max();  ///< for the scene with every copied instance
};

/// Assembles the scene, with every instance expanded, or with copies of base meshes left out. Throws Nonsense for invalid data:
/// more than was announced; an index, a count, a kind or a number out of its range; a view that shows nothing;
/// core::CapacityError if the instances need more memory than there is; std::bad_alloc if memory is exhausted.
class SceneReceiver {
 public:
  explicit SceneReceiver(const ReceivingLimits& limits = {}, core::Copies copies = core::Copies::put)
      : limits_(limits), copies_(copies) {}

  /// Returns whether the message belongs to a scene, and takes it.
  bool take(const Message& message);
  /// Fills a buffer, and returns whether it could.
  using Fill = std::function<bool(std::span<std::byte>)>;
  /// Reads `bytes` of a list's entries from `fill`, piece by piece, as from a message of `saying`. Returns false, and keeps none
  /// of them, if `fill` does.
  bool take_from(Saying saying, std::uint64_t bytes, const Fill& fill);
  /// Throws Nonsense if there are too many.
  void add(core::Texture texture);

  /// The scene; this object becomes empty. Requires the last message.
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
  std::map<Saying, std::uint64_t> announced_;  ///< announced number of entries of each list
  bool has_head_ = false;
};

}  // namespace dmpc::apps
