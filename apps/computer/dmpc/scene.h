// Scenes for programs that implement their own rendering strategy: a database of records in pages, and pixels that read it. This
// header needs no other header of dmpc except <dmpc/pages.h>.
#pragma once

#include <dmpc/pages.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dmpc {

/// A page from Pages::find() for a pixel must be readable for this many bytes past its end; their values do not matter.
inline constexpr std::size_t overread_bytes = 32;

/// A scene and a picture of it with one sample per pixel. Immutable: nodes' programs may access everything except the records.
class Scene {
 public:
  /// Loads a built-in scene, such as "rings-3-t1", in pages of a power of two from 512 B to 64 KiB. Otherwise throws UsageError.
  Scene(const std::string& name, std::uint32_t width, std::uint32_t height, std::size_t page_bytes = 1024);

  std::uint32_t pixel_count() const;
  std::size_t page_bytes() const;
  std::uint32_t page_count() const;
  /// Returns all pages consecutively, followed by overread_bytes more readable bytes.
  std::span<const std::byte> records() const;

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// Returns the operations charged for a pixel's work, with prices for a core of today: operations 0 .. scene_operation_count - 1
/// of a program that renders, which may add its own after them.
std::vector<OperationNeed> scene_operations();
inline constexpr Index scene_operation_count = 8;

/// The contribution of a pixel's rays, in units that can be added in any order.
struct Light {
  std::array<std::int64_t, 6> sums{};
};

/// Renders one pixel at a time, depth first.
class PixelTask {
 public:
  /// Uses `memory` of memory_bytes(scene) bytes, as returned by Node::allocate(). The scene outlives this object.
  PixelTask(const Scene& scene, std::span<std::byte> memory);
  static std::size_t memory_bytes(const Scene& scene);
  /// Uses memory outside of the nodes, for work before the start.
  explicit PixelTask(const Scene& scene);

  void start(std::uint32_t pixel);
  /// Traces or continues one ray. The task completes even if only one page is available at a time.
  Step run(Pages& pages);
  /// Returns the light of the finished pixel.
  Light light() const;

 private:
  struct State;
  PixelTask(const Scene& scene, std::shared_ptr<std::byte[]> memory);

  const Scene* scene_;
  std::shared_ptr<std::byte[]> own_;  ///< only if the memory is not a node's
  State* state_;
};

/// The picture to which pixels are added.
class Picture {
 public:
  explicit Picture(const Scene& scene);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  void put(std::uint32_t pixel, const Light& light);
  /// Returns 16 digits: the film_hash in `dmpc render --stats` for the same picture.
  std::string hash() const;

 private:
  struct Film;
  std::unique_ptr<Film> film_;
};

}  // namespace dmpc
