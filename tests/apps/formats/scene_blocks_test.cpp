#include "apps/formats/scene_blocks.h"

#include <doctest/doctest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <thread>
#include <utility>

#include "core/scene/base_meshes.h"
#include "tests/support/complaint.h"

namespace dmpc::apps::scene_blocks_test {

namespace {

using core::ObjectKind;

/// A triangle of each kind that meshes have.
core::Scene three_triangles() {
  core::Scene scene;
  scene.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.normals = {{0, 0, 1}, {0, 0, 1}, {0, 1, 1}};
  scene.corners.resize(3);
  scene.materials = {{}, {.texture = 0}};
  scene.objects = {{ObjectKind::polygon, 0, 0, 3, 0}, {ObjectKind::patch, 0, 0, 3, 0}, {ObjectKind::textured, 1, 0, 3, 0}};
  scene.lights = {{{1, 2, 3}, {0.5, 0.5, 0.5}, true}, {{4, 5, 6}}};
  scene.view.width = 640;
  scene.zenith = {0, 1, 0};
  return scene;
}

/// Each vertex at a point of its own.
IndexedVertices vertices_of(const core::Scene& scene) {
  IndexedVertices vertices{scene.vertices, std::vector<std::uint32_t>(scene.vertices.size())};
  std::iota(vertices.indices.begin(), vertices.indices.end(), 0U);
  return vertices;
}

/// The scene after a transfer through a pipe, with `textures` textures of a texel.
core::Scene sent(core::Scene scene, IndexedVertices vertices, int textures = 1, core::Instances instances = {},
                 const ReceivingLimits& limits = {}, core::Copies copies = core::Copies::put) {
  auto [mine, its] = make_ends();
  Line sender(std::move(mine)), receiver(std::move(its));
  std::jthread writer([&] {
    send_scene(scene, vertices, instances, sender, Handing::in_messages);
    sender.send(Saying::done);
  });
  SceneReceiver whole(limits, copies);
  for (int i = 0; i < textures; ++i) {
    whole.add({.name = "t", .levels = {{1, 1, {0x808080}}}});
  }
  while (true) {
    const std::optional<Message> message = receiver.receive(false);
    if (!whole.take(*message)) {
      return whole.finish();
    }
  }
}

/// What a reader hands over is looked for where it says, or not at all.
core::Scene handed_over(core::Scene scene, bool is_let) {
  IndexedVertices vertices = vertices_of(scene);
  core::Instances instances;
  auto [mine, its] = make_ends();
  Line sender(std::move(mine)), receiver(std::move(its));
  std::jthread writer([&] {
    send_scene(scene, vertices, instances, sender, Handing::from_memory);
    sender.send(Saying::done);
  });
  SceneReceiver whole;
  whole.add({.name = "t", .levels = {}});
  for (std::optional<Message> message = receiver.receive(false); message->saying != Saying::done;
       message = receiver.receive(false)) {
    if (message->saying != Saying::lies_here) {
      whole.take(*message);
      continue;
    }
    Unpacker fields(message->bytes);
    const Saying list = fields.take_choice(Saying::vertices);
    const auto* from = reinterpret_cast<const std::byte*>(fields.take<std::uint64_t>());
    std::size_t pieces = 0;
    const bool is_here = whole.take_from(list, fields.take<std::uint64_t>(), [&](std::span<std::byte> room) {
      std::memcpy(room.data(), std::exchange(from, from + room.size()), room.size());
      return is_let || ++pieces < 3;
    });
    CHECK(is_here == is_let);
    receiver.send(is_here ? Saying::yes : Saying::no);
  }
  return whole.finish();
}

core::Scene sent(const core::Scene& scene) { return sent(scene, vertices_of(scene)); }

bool is_nonsense(const std::function<void()>& act) { return !tests::complaint_of<Nonsense>(act).empty(); }

bool is_refused(const std::function<void(core::Scene&)>& spoil) {
  core::Scene scene = three_triangles();
  spoil(scene);
  return is_nonsense([&] { sent(scene); });
}

/// A head that announces `materials` materials, and one entry of each other list.
std::string head_of(std::uint64_t materials) {
  const core::Scene scene = three_triangles();
  Packer head;
  constexpr int no_bounces = -1;
  head.add(scene.view).add(scene.zenith).add(scene.background).add(scene.coordinate_rounding).add(no_bounces).add(materials);
  for (int pool = 1; pool < 8; ++pool) {
    head.add(std::uint64_t{1});
  }
  return head.bytes();
}

}  // namespace

TEST_CASE("a scene comes through the line as it was") {
  const core::Scene before = three_triangles(), after = sent(before);
  CHECK(after.vertices == before.vertices);
  CHECK(after.normals == before.normals);
  CHECK(after.materials == before.materials);
  CHECK(after.objects.size() == 3);
  CHECK(after.objects[2].kind == ObjectKind::textured);
  CHECK(after.lights[0].has_color);
  CHECK_FALSE(after.lights[1].has_color);
  CHECK(after.view.width == 640);
  CHECK(after.zenith == core::Vec3d{0, 1, 0});
}

TEST_CASE("a scene of many messages comes through, too") {
  core::Scene scene = three_triangles();
  scene.vertices.resize(100'000);
  scene.vertices.back() = {7, 8, 9};
  CHECK(sent(scene).vertices.back() == core::Vec3d{7, 8, 9});
}

TEST_CASE("vertices that share a point come through a line as it, and each gets its own place") {
  core::Scene scene = three_triangles();
  const IndexedVertices vertices{{{1, 2, 3}, {4, 5, 6}}, {1, 0, 1, 1}};
  CHECK(sent(scene, vertices).vertices == expanded(vertices));
}

TEST_CASE("a vertex at a point that has not come is refused, and so is a point that nothing has, if it is none") {
  const core::Scene scene = three_triangles();
  IndexedVertices vertices = vertices_of(scene);
  vertices.points.push_back({1.1e30, 0, 0});
  CHECK_THROWS_AS(sent(scene, vertices), Nonsense);
  vertices.points.pop_back();
  vertices.indices[1] = 3;
  CHECK_THROWS_AS(sent(scene, vertices), Nonsense);
}

TEST_CASE("lists that are handed over come as those in messages do, and so do those that cannot be looked at") {
  core::Scene scene = three_triangles();
  scene.vertices.resize(1'000'000);
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    scene.vertices[i].y = static_cast<double>(i);
  }
  for (const bool is_let : {true, false}) {
    const core::Scene after = handed_over(scene, is_let);
    CHECK(after.vertices == scene.vertices);
    CHECK(after.normals == scene.normals);
    CHECK(after.objects.size() == 3);
  }
}

TEST_CASE("what stands in several places comes once, and is there in all of them") {
  const core::Scene before = three_triangles();
  const core::Instances instances{.meshes = {{1, 3}}, .places = {{{.shift = {0, 0, 1}}, 0, 3}, {{.shift = {0, 0, 2}}, 0, 3}}};
  const core::Scene after = sent(before, vertices_of(before), 1, instances);
  core::Scene expected = before;
  core::expand(expected, instances);
  REQUIRE(after.objects.size() == 5);
  CHECK(after.vertices == expected.vertices);
  CHECK(after.vertices[9] == core::Vec3d{0, 0, 2});
  CHECK(after.objects[4].kind == ObjectKind::textured);
}

TEST_CASE("instances that cannot be are refused, and so is what they would take beyond the memory that there is") {
  const core::Scene scene = three_triangles();
  const auto is_refused = [&scene](const core::Instances& instances) {
    return is_nonsense([&] { sent(scene, vertices_of(scene), 1, instances); });
  };
  const core::Transform here, far{.shift = {1.1e30, 0, 0}}, nowhere{.shift = {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  CHECK_FALSE(is_refused({.meshes = {{0, 1}, {1, 3}}, .places = {{here, 1, 0}, {here, 0, 3}}}));
  CHECK(is_refused({.meshes = {{1, 1}}}));
  CHECK(is_refused({.meshes = {{2, 1}}}));
  CHECK(is_refused({.meshes = {{1, 4}}}));
  CHECK(is_refused({.meshes = {{0, 2}, {1, 3}}}));
  CHECK(is_refused({.meshes = {{0, 1}}, .places = {{here, 1, 0}}}));
  CHECK(is_refused({.meshes = {{0, 1}}, .places = {{here, 0, 4}}}));
  CHECK(is_refused({.meshes = {{0, 1}}, .places = {{here, 0, 3}, {here, 0, 2}}}));
  CHECK(is_refused({.meshes = {{0, 1}}, .places = {{far, 0, 3}}}));
  CHECK(is_refused({.meshes = {{0, 1}}, .places = {{nowhere, 0, 3}}}));
  const core::Instances thousand{.meshes = {{0, 3}}, .places = std::vector<core::Instance>(1000, {here, 0, 3})};
  const std::uint64_t bytes = core::expanded_size(scene, thousand).bytes();
  CHECK(sent(scene, vertices_of(scene), 1, thousand, {.expanded_bytes = bytes}).objects.size() == 3000);
  CHECK_THROWS_WITH_AS(sent(scene, vertices_of(scene), 1, thousand, {.expanded_bytes = bytes - 1}),
                       doctest::Contains("with every instance it takes"), core::CapacityError);
}

TEST_CASE("copies of what is large and stands in several places are left out if that is asked for, and take no memory") {
  core::Scene scene = three_triangles();
  for (int i = 0; i < 97; ++i) {
    scene.objects.push_back({ObjectKind::polygon, 0, 0, 3, 0});
  }
  const core::Instances thousand{.meshes = {{0, 100}}, .places = std::vector<core::Instance>(1000, {{}, 0, 100})};
  const auto left_out = [&](const core::Instances& instances, std::uint64_t bytes) {
    return sent(scene, vertices_of(scene), 1, instances, {.expanded_bytes = bytes}, core::Copies::left_out);
  };
  const core::Scene after = left_out(thousand, 0);
  CHECK(after.objects.empty());
  REQUIRE(after.kept);
  CHECK(after.kept->places.size() == 1000);
  CHECK_THROWS_AS(sent(scene, vertices_of(scene), 1, thousand, {.expanded_bytes = 0}), core::CapacityError);
  const core::Instances once{.meshes = {{0, 100}}, .places = {{{}, 0, 100}}};
  CHECK(left_out(once, 1 << 20U).objects.size() == 100);
  const core::Transform far{.shift = {1.1e30, 0, 0}}, nowhere{.shift = {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  for (const core::Transform& world : {far, nowhere}) {
    core::Instances moved = thousand;
    moved.places[999].world = world;
    CHECK_THROWS_AS(left_out(moved, 0), Nonsense);
  }
}

TEST_CASE("what is round stands where it is beside what stands in several places, and in none of these") {
  core::Scene scene = three_triangles();
  scene.spheres = {{{1, 2, 3}, 4}};
  scene.objects.insert(scene.objects.begin(), {ObjectKind::sphere, 0, 0, 0, 0});
  const auto with_mesh = [&](std::uint32_t first) {
    return sent(scene, vertices_of(scene), 1, {.meshes = {{first, 3}}, .places = {{{}, 0, 3}, {{}, 0, 3}}});
  };
  const core::Scene after = with_mesh(1);
  REQUIRE(after.objects.size() == 6);
  CHECK(after.objects[0].kind == ObjectKind::sphere);
  CHECK(after.objects[0].first == 0);
  CHECK(after.spheres.size() == 1);
  CHECK_THROWS_AS(with_mesh(0), Nonsense);
}

TEST_CASE("more than was announced is not taken from anywhere") {
  const auto nothing = [](std::span<std::byte> /*room*/) { return true; };
  SceneReceiver receiver;
  CHECK_THROWS_AS(receiver.take_from(Saying::points, 24, nothing), Nonsense);
  receiver.take({Saying::scene, head_of(1), Descriptor()});
  CHECK_THROWS_AS(receiver.take_from(Saying::lights, 24, nothing), Nonsense);
  for (const auto& [list, entry_bytes] : {std::pair{Saying::points, std::uint64_t{24}}, {Saying::vertices, 4}}) {
    CHECK_THROWS_AS(receiver.take_from(list, 0, nothing), Nonsense);
    CHECK_THROWS_AS(receiver.take_from(list, entry_bytes + 1, nothing), Nonsense);
    CHECK_THROWS_AS(receiver.take_from(list, entry_bytes << 40U, nothing), Nonsense);
    CHECK(receiver.take_from(list, entry_bytes, nothing));
    CHECK_THROWS_AS(receiver.take_from(list, entry_bytes, nothing), Nonsense);
  }
}

TEST_CASE("a scene that cannot be is refused, whatever is wrong with it") {
  CHECK_FALSE(is_refused([](core::Scene&) {}));
  CHECK(is_refused([](core::Scene& scene) { scene.objects[0].kind = ObjectKind::sphere; }));
  CHECK(is_refused([](core::Scene& scene) { scene.objects[0].kind = static_cast<ObjectKind>(200); }));
  CHECK(is_refused([](core::Scene& scene) { scene.objects[0].material = 2; }));
  CHECK(is_refused([](core::Scene& scene) { scene.objects[0].first = 1; }));
  CHECK(is_refused([](core::Scene& scene) { scene.objects[0].first = 0xffffffffU; }));
  CHECK(is_refused([](core::Scene& scene) { scene.objects[0].vertex_count = 2; }));
  CHECK(is_refused([](core::Scene& scene) { scene.objects[1].first_normal = 1; }));
  CHECK(is_refused([](core::Scene& scene) { scene.objects[2].first_normal = 1; }));
  CHECK(is_refused([](core::Scene& scene) { scene.materials[1].texture = 1; }));
  CHECK(is_refused([](core::Scene& scene) { scene.materials[0].shine = -1; }));
  CHECK(is_refused([](core::Scene& scene) { scene.materials[0].mirror = 1.5; }));
  CHECK_FALSE(is_refused([](core::Scene& scene) { scene.materials[0].microfacets = {.roughness = 1, .metallic = 1}; }));
  CHECK(is_refused([](core::Scene& scene) { scene.materials[0].microfacets.roughness = 1.5; }));
  CHECK(is_refused([](core::Scene& scene) { scene.materials[0].microfacets.roughness = -0.5; }));
  CHECK(is_refused([](core::Scene& scene) { scene.materials[0].microfacets = {.roughness = 0.5, .metallic = -1}; }));
  CHECK(is_refused([](core::Scene& scene) { scene.materials[0].microfacets = {.roughness = 0.5, .opacity = 2}; }));
  CHECK(is_refused(
      [](core::Scene& scene) { scene.materials[0].microfacets.reflectance = std::numeric_limits<double>::quiet_NaN(); }));
  CHECK(is_refused([](core::Scene& scene) { scene.materials[0].microfacets = {.roughness = 0.5, .transmission = 1.5}; }));
  CHECK(is_refused([](core::Scene& scene) {
    scene.materials[0].specular_color = {1e20, 0, 0}, scene.materials[0].specular = 1e20;
  }));
  CHECK(is_refused([](core::Scene& scene) {
    scene.materials[0].color = {1e20, 0, 0}, scene.materials[0].tinted_specular = 1e20;
  }));
  CHECK(is_refused([](core::Scene& scene) { scene.materials[0].color.x = std::numeric_limits<double>::quiet_NaN(); }));
  CHECK(is_refused([](core::Scene& scene) { scene.vertices[0].x = std::numeric_limits<double>::infinity(); }));
  CHECK(is_refused([](core::Scene& scene) { scene.lights[0].position.x = 1e31; }));
  CHECK(is_refused([](core::Scene& scene) { scene.view.width = 0; }));
  CHECK(is_refused([](core::Scene& scene) { scene.view.at = scene.view.from; }));
  CHECK(is_refused([](core::Scene& scene) { scene.zenith = {0, 2, 0}; }));
}

TEST_CASE("a texture of metal and roughness is one by itself, beside that of a colour and of what has places on it, or refused") {
  using core::FacetTexture;
  const core::Microfacets good{.roughness = 1, .metallic = 1, .texture = 1};
  const auto is_refused = [](const core::Microfacets& facets, std::uint32_t material = 1) {
    core::Scene scene = three_triangles();
    scene.materials[material].microfacets = facets;
    return is_nonsense([&] { sent(scene, vertices_of(scene), 2); });
  };
  const auto with = [&good](const auto& change) {
    core::Microfacets facets = good;
    change(facets);
    return facets;
  };
  CHECK_FALSE(is_refused(good));
  CHECK_FALSE(is_refused(with([](auto& facets) { facets.use = FacetTexture::mean; })));
  CHECK_FALSE(is_refused(with([](auto& facets) { facets.use = FacetTexture::mean; }), 0));
  CHECK(is_refused(good, 0));                                            // neither a colour's texture nor places
  CHECK(is_refused(with([](auto& facets) { facets.texture = 2; })));     // which has not come
  CHECK(is_refused(with([](auto& facets) { facets.texture = 0; })));     // the colour's
  CHECK(is_refused(with([](auto& facets) { facets.roughness = -1; })));  // a surface without microfacets
  CHECK(is_refused(with([](auto& facets) { facets.use = static_cast<FacetTexture>(2); })));
  core::Scene scene = three_triangles();
  scene.materials[1].microfacets = good;
  scene.objects[0].material = 1;  // a polygon
  CHECK_THROWS_AS(sent(scene, vertices_of(scene), 2), Nonsense);
}

TEST_CASE("more than was announced, and parts of an entry, are refused") {
  SceneReceiver receiver;
  CHECK_THROWS_AS(receiver.take({Saying::points, std::string(24, '\0'), Descriptor()}), Nonsense);
  CHECK(receiver.take({Saying::scene, head_of(1), Descriptor()}));
  CHECK_THROWS_AS(receiver.take({Saying::points, std::string(25, '\0'), Descriptor()}), Nonsense);
  CHECK_THROWS_AS(receiver.take({Saying::points, std::string(48, '\0'), Descriptor()}), Nonsense);
  CHECK_THROWS_AS(receiver.take({Saying::scene, head_of(1), Descriptor()}), Nonsense);
}

TEST_CASE("more lights, textures and materials than any scene has are refused before they take memory") {
  SceneReceiver receiver;
  CHECK_THROWS_AS(receiver.take({Saying::scene, head_of(std::uint64_t{1} << 30U), Descriptor()}), Nonsense);
  SceneReceiver other;
  const auto add_all = [&other] {
    for (int i = 0; i < 70'000; ++i) {
      other.add(core::Texture{});
    }
  };
  CHECK_THROWS_AS(add_all(), Nonsense);
}

}  // namespace dmpc::apps::scene_blocks_test
