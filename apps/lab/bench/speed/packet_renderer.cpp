#include "apps/lab/bench/speed/packet_renderer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstring>
#include <numeric>
#include <utility>

#include "apps/lab/bench/speed/crew.h"
#include "apps/lab/bench/speed/packet_shading.h"
#include "apps/lab/bench/speed/plain_stage.h"
#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::apps {
namespace {

using core::Color;
using core::Vec3f;

/// Rays to this depth, and their shadow rays, are told to be coherent: what comes later is slower so.
constexpr int coherent_depth = 2;
/// A packet of the eye's covers so many pixels' sides.
constexpr int packet_side = 4;
static_assert(packet_side * packet_side == packet_rays && plain_tile_side % packet_side == 0);

void put(const Vec3f& vector, float* row) {
  row[0] = vector.x;
  row[1] = vector.y;
  row[2] = vector.z;
}

void put(const Vec3f& vector, std::size_t i, VectorRow& rows) {
  rows.x[i] = vector.x;
  rows.y[i] = vector.y;
  rows.z[i] = vector.z;
}

std::vector<float> triangle_table(const PlainStage& stage) {
  std::vector<float> table(std::max<std::size_t>(stage.triangle_count(), 1) * triangle_fields);
  for (unsigned triangle = 0; triangle < stage.triangle_count(); ++triangle) {
    float* const row = &table[triangle * triangle_fields];
    const core::PatchNormals* const normals = stage.normals_of(triangle);
    for (std::size_t corner = 0; normals != nullptr && corner < 3; ++corner) {
      put(normals->normal[corner], row + 3 * corner);
    }
    row[9] = std::bit_cast<float>(normals != nullptr ? normals->material() : stage.flat_material_of(triangle));
  }
  return table;
}

std::vector<float> material_table(const PlainStage& stage) {
  std::vector<float> table(stage.materials().size() * material_fields);
  for (std::size_t i = 0; i < stage.materials().size(); ++i) {
    const PlainMaterial& material = stage.materials()[i];
    float* const row = &table[i * material_fields];
    const Color diffuse = material.color * material.diffuse;
    put(diffuse, row + diffuse_field);
    put(material.highlight, row + highlight_field);
    put(material.highlight * material.mirror, row + mirrored_field);
    put(material.emission + stage.settings().header.ambient * diffuse, row + own_field);
    row[shine_field] = material.shine;
    row[transmittance_field] = material.transmittance;
    row[index_field] = material.inside_index();
    row[glossy_field] = material.is_glossy() ? 1.0F : 0.0F;
  }
  return table;
}

std::uint64_t count_of(const IntRow& row) {
  return packet_rays - static_cast<std::uint64_t>(std::count(row.begin(), row.end(), 0));
}

void copy(const VectorRow& rows, float* x, float* y, float* z) {
  std::copy(rows.x.begin(), rows.x.end(), x);
  std::copy(rows.y.begin(), rows.y.end(), y);
  std::copy(rows.z.begin(), rows.z.end(), z);
}

}  // namespace

/// What all threads read.
struct PacketRenderer::Tables {
  PlainStage stage;
  std::vector<float> triangles, materials;
  const PacketShading& shading = packet_shading();

  Tables(const Subject& subject, EmbreeMode mode)
      : stage(subject, mode), triangles(triangle_table(stage)), materials(material_table(stage)) {}
};

/// One thread at work.
class PacketRenderer::Painter {
 public:
  Painter(const Tables& tables, PlainPicture& picture) : tables_(tables), picture_(picture) { embree::start(context_); }

  void paint(int left, int top) {
    const core::Camera& camera = tables_.stage.settings().camera;
    depth_ = 1;
    for (int y = top; y < std::min(top + plain_tile_side, camera.height()); y += packet_side) {
      for (int x = left; x < std::min(left + plain_tile_side, camera.width()); x += packet_side) {
        look(x, y);
        follow();
      }
    }
    while (next_[0].count + next_[1].count > 0) {
      ++depth_;
      std::swap(here_, next_);
      next_[0].clear();
      next_[1].clear();
      follow_all(here_[0]);
      follow_all(here_[1]);
    }
  }

  std::uint64_t rays() const { return rays_; }

 private:
  /// The eye's rays through some pixels.
  void look(int left, int top) {
    const PlainCamera& camera = tables_.stage.camera();
    const int width = tables_.stage.settings().camera.width(), height = tables_.stage.settings().camera.height();
    for (std::size_t i = 0; i < packet_rays; ++i) {
      const int x = left + static_cast<int>(i) % packet_side, y = top + static_cast<int>(i) / packet_side;
      hits_.active[i] = x < width && y < height ? -1 : 0;
      hits_.pixel[i] = y * width + x;
      put(camera.eye, i, hits_.origin);
      put(camera.towards(x, y), i, hits_.direction);
      put({1, 1, 1}, i, hits_.weight);
    }
  }

  void follow_all(RayQueue& queue) {
    for (std::size_t first = 0; first < queue.count; first += packet_rays) {
      load(queue, first);
      follow();
    }
  }

  void load(RayQueue& queue, std::size_t first) {
    if (first + packet_rays > queue.count) {
      queue.close(first + packet_rays);
    }
    const auto take = [&](std::size_t row, FloatRow& numbers) {
      std::copy_n(queue.row[row].data() + first, packet_rays, numbers.data());
    };
    for (const auto& [row, rows] : {std::pair{0, &hits_.origin}, {3, &hits_.direction}, {6, &hits_.weight}}) {
      take(static_cast<std::size_t>(row), rows->x);
      take(static_cast<std::size_t>(row) + 1, rows->y);
      take(static_cast<std::size_t>(row) + 2, rows->z);
    }
    std::copy_n(queue.pixel.data() + first, packet_rays, hits_.pixel.data());
    for (std::size_t i = 0; i < packet_rays; ++i) {
      hits_.active[i] = first + i < queue.count ? -1 : 0;
    }
  }

  /// Traces the packet, adds the light it finds, and queues the rays it spawns.
  void follow() {
    rays_ += count_of(hits_.active);
    if (trace()) {
      tables_.shading.find_materials(hits_, tables_.materials.data());
      for (const core::LightRecord& light : tables_.stage.lights()) {
        shine(light);
      }
      deposit();
      if (depth_ < tables_.stage.settings().shade.depth_max) {
        next_[0].reserve_more(packet_rays);
        next_[1].reserve_more(packet_rays);
        tables_.shading.send(hits_, next_[0], next_[1]);
      }
    }
  }

  /// Leaves those active that hit something; returns whether anybody does. The others see the background.
  bool trace() {
    embree::Packet packet{.is_coherent = depth_ <= coherent_depth};
    std::copy(hits_.active.begin(), hits_.active.end(), packet.valid.begin());
    RTCRayHit16& asked = asked_;
    copy(hits_.origin, asked.ray.org_x, asked.ray.org_y, asked.ray.org_z);
    copy(hits_.direction, asked.ray.dir_x, asked.ray.dir_y, asked.ray.dir_z);
    std::fill_n(asked.ray.tnear, packet_rays, 0.0F);
    std::fill_n(asked.ray.tfar, packet_rays, std::numeric_limits<float>::infinity());
    std::fill_n(asked.ray.mask, packet_rays, ~0U);
    std::fill_n(asked.hit.geomID, packet_rays, RTC_INVALID_GEOMETRY_ID);
    embree::intersect(tables_.stage.tree().library(), tables_.stage.tree().scene(), context_, packet, asked);
    bool is_anybody = false;
    for (std::size_t i = 0; i < packet_rays; ++i) {
      const bool hits = asked.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      if (hits_.active[i] != 0 && !hits) {
        add(i, tables_.stage.settings().header.background);
        hits_.active[i] = 0;
      }
      is_anybody |= hits_.active[i] != 0;
      hits_.triangle[i] = hits_.active[i] != 0 && tables_.stage.is_triangle(asked.hit.geomID[i])
                              ? static_cast<std::int32_t>(asked.hit.primID[i])
                              : 0;
    }
    if (is_anybody) {
      find_surfaces();
    }
    return is_anybody;
  }

  void find_surfaces() {
    std::copy_n(asked_.ray.tfar, packet_rays, hits_.t.data());
    std::copy_n(asked_.hit.u, packet_rays, hits_.u.data());
    std::copy_n(asked_.hit.v, packet_rays, hits_.v.data());
    VectorRow normals;
    std::copy_n(asked_.hit.Ng_x, packet_rays, normals.x.data());
    std::copy_n(asked_.hit.Ng_y, packet_rays, normals.y.data());
    std::copy_n(asked_.hit.Ng_z, packet_rays, normals.z.data());
    tables_.shading.find_surfaces(hits_, normals, tables_.triangles.data());
    for (std::size_t i = 0; i < packet_rays && !tables_.stage.tree().shapes().curved.empty(); ++i) {
      if (hits_.active[i] == 0) {
        hits_.material[i] = 0;
      } else if (!tables_.stage.is_triangle(asked_.hit.geomID[i])) {
        put_curved(i);
      }
    }
  }

  void put_curved(std::size_t i) {
    const PlainSurface surface =
        tables_.stage.curved_at(asked_.hit.primID[i], {hits_.origin.x[i], hits_.origin.y[i], hits_.origin.z[i]},
                                {hits_.direction.x[i], hits_.direction.y[i], hits_.direction.z[i]}, hits_.t[i]);
    put(surface.point, i, hits_.point);
    put(surface.geometric_normal, i, hits_.geometric_normal);
    put(surface.normal, i, hits_.normal);
    hits_.leaving[i] = surface.is_leaving ? -1 : 0;
    hits_.material[i] = static_cast<std::int32_t>(surface.material);
  }

  void shine(const core::LightRecord& light) {
    PacketLight met;
    if (!tables_.shading.meet_light(hits_, light, met)) {
      return;
    }
    rays_ += count_of(met.asked);
    embree::Packet packet{.is_coherent = depth_ <= coherent_depth};
    std::copy(met.asked.begin(), met.asked.end(), packet.valid.begin());
    RTCRay16& asked = shadows_;
    copy(met.start, asked.org_x, asked.org_y, asked.org_z);
    copy(met.way, asked.dir_x, asked.dir_y, asked.dir_z);
    std::fill_n(asked.tnear, packet_rays, 0.0F);
    std::fill_n(asked.tfar, packet_rays, plain_light_end);
    std::fill_n(asked.mask, packet_rays, ~0U);
    embree::occlude(tables_.stage.tree().library(), tables_.stage.tree().scene(), context_, packet, asked);
    tables_.shading.add_light(hits_, met, asked.tfar);
  }

  void deposit() {
    for (std::size_t i = 0; i < packet_rays; ++i) {
      if (hits_.active[i] != 0) {
        add(i, {hits_.light.x[i], hits_.light.y[i], hits_.light.z[i]});
      }
    }
  }

  void add(std::size_t i, const Color& light) {
    Color& pixel = picture_.pixels[static_cast<std::size_t>(hits_.pixel[i])];
    pixel = pixel + light * Color{hits_.weight.x[i], hits_.weight.y[i], hits_.weight.z[i]};
  }

  const Tables& tables_;
  PlainPicture& picture_;
  embree::Context context_;
  PacketHits hits_{};
  RTCRayHit16 asked_{};
  RTCRay16 shadows_{};
  int depth_ = 1;                        ///< rays of the eye are told to be coherent, others not
  std::array<RayQueue, 2> here_, next_;  ///< what is reflected and what is refracted: each has a direction of its own
  std::uint64_t rays_ = 0;
};

PacketRenderer::PacketRenderer(const Subject& subject, EmbreeMode mode) : tables_(std::make_unique<Tables>(subject, mode)) {}
PacketRenderer::~PacketRenderer() = default;

PlainPicture PacketRenderer::render(std::uint32_t thread_count) const {
  const core::Camera& camera = tables_->stage.settings().camera;
  const int columns = core::ceil_divide(camera.width(), plain_tile_side);
  const int tiles = columns * core::ceil_divide(camera.height(), plain_tile_side);
  PlainPicture picture{.pixels = core::ZeroedArray<Color>(camera.pixel_count())};
  std::vector<std::uint64_t> rays(thread_count);
  std::atomic<int> next_tile = 0;
  on_threads(thread_count, [&](std::size_t thread) {
    Painter painter(*tables_, picture);
    for (int tile = next_tile++; tile < tiles; tile = next_tile++) {
      painter.paint(tile % columns * plain_tile_side, tile / columns * plain_tile_side);
    }
    rays[thread] = painter.rays();
  });
  picture.rays = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
  return picture;
}

}  // namespace dmpc::apps
