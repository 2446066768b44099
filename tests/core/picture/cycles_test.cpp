// Light that surfaces scatter under a sky, or from emitters, compared with an independent integrator: Cycles, of Blender 3.4.1
// from Debian 12.
//
// Its figures are means over eight runs of 8,192 samples, each of 4x4 pixels, whose own errors are below 2e-4: `blender -b
// --factory-startup -P script`, engine CYCLES on one thread, max_bounces and diffuse_bounces as below, pixel filter BOX of width
// 1, no adaptive sampling, no denoising, clamps 0, light_sampling_threshold 0, use_fast_gi off, view transform Raw, EXR of 32
// bits; materials a diffuse BSDF of roughness 0; the world's colour a MixRGB of horizon and zenith by the maximum of 0 and z of
// the generated coordinates. A camera's angle spans its pixels there, from side to side; of an NFF view it spans their middles.
#include <doctest/doctest.h>

#include "tests/support/cycles_pictures.h"

namespace cycles_test {

using namespace dmpc::core;
using namespace dmpc::tests::cycles;

namespace {

Model corner() {
  Model model({5, -6, 3}, {1.5, 1.5, 1}, 40);
  model.fill({.8, .8, .8});
  model.floor(0, 4);
  model.fill({.7, .2, .15});
  model.face({{0, 0, 0}, {0, 4, 0}, {0, 4, 2.5}, {0, 0, 2.5}});
  model.fill({.2, .6, .3});
  model.face({{0, 4, 0}, {4, 4, 0}, {4, 4, 2.5}, {0, 4, 2.5}});
  model.fill({.6, .6, .9});
  model.box({1, 1.5, 0}, {2.2, 2.7, 1.3});
  return model;
}

Model court() {
  Model model({2, 2.2, 9}, {2, 2, 0}, 34);
  model.fill({.75, .7, .6});
  model.floor(0, 4);
  model.fill({.8, .8, .8});
  model.face({{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}});
  model.fill({.7, .3, .2});
  model.face({{4, 0, 0}, {4, 4, 0}, {4, 4, 3}, {4, 0, 3}});
  model.fill({.5, .5, .8});
  model.face({{4, 4, 0}, {0, 4, 0}, {0, 4, 3}, {4, 4, 3}});
  model.fill({.4, .7, .4});
  model.face({{0, 4, 0}, {0, 0, 0}, {0, 0, 3}, {0, 4, 3}});
  model.fill({.9, .9, .9});
  model.box({1.6, 1.6, 0}, {2.4, 2.4, 1.5});
  return model;
}

Model steps() {
  Model model({4, -7, 4}, {1.5, 1.5, .9}, 36);
  for (int step = 0; step < 5; ++step) {
    model.fill(step % 2 == 0 ? Vec3d{.8, .5, .3} : Vec3d{.7, .7, .7});
    model.box({0, .6 * step, 0}, {3, .6 * (step + 1), .4 * (step + 1)});
  }
  model.fill({.5, .5, .5});
  model.floor(-20, 20);
  return model;
}

Model arcade() {
  Model model({2, -5, 1.2}, {2, 2, 1.1}, 45);
  model.fill({.7, .7, .7});
  model.floor(-20, 20);
  model.fill({.85, .85, .8});
  model.box({-.5, 0, 2}, {4.5, 4, 2.3});
  model.fill({.8, .6, .4});
  model.face({{-.5, 4, 0}, {4.5, 4, 0}, {4.5, 4, 2}, {-.5, 4, 2}});
  model.fill({.6, .7, .8});
  for (const double x : {0.0, 1.8, 3.6}) {
    model.box({x, .2, 0}, {x + .4, .6, 2});
  }
  return model;
}

/// A room with walls of several colours, a box and a panel below its ceiling.
Model vault() {
  Model model({2, -3.2, 1.6}, {2, 2, 1.1}, 50);
  model.fill({.7, .7, .7});
  model.floor(0, 4);
  model.fill({.8, .8, .8});
  model.face({{0, 0, 2.5}, {4, 0, 2.5}, {4, 4, 2.5}, {0, 4, 2.5}});
  model.fill({.75, .75, .7});
  model.face({{0, 4, 0}, {4, 4, 0}, {4, 4, 2.5}, {0, 4, 2.5}});
  model.fill({.7, .2, .15});
  model.face({{0, 0, 0}, {0, 4, 0}, {0, 4, 2.5}, {0, 0, 2.5}});
  model.fill({.2, .6, .3});
  model.face({{4, 0, 0}, {4, 4, 0}, {4, 4, 2.5}, {4, 0, 2.5}});
  model.fill({.6, .6, .9});
  model.box({1, 1.5, 0}, {2, 2.5, 1.2});
  model.shine({8, 7, 5});
  model.face({{1.5, 1.5, 2.4}, {2.5, 1.5, 2.4}, {2.5, 2.5, 2.4}, {1.5, 2.5, 2.4}});
  return model;
}

/// The steps, lit by a small bright box before them and a large dim panel beside them.
Model lit_steps() {
  Model model = steps();
  model.shine({30, 20, 10});
  model.box({.2, -1, 1}, {.5, -.7, 1.3});
  model.shine({.5, 1, 2});
  model.face({{3.4, 0, .5}, {3.4, 3, .5}, {3.4, 3, 2}, {3.4, 0, 2}});
  return model;
}

Film under_sky(Scene scene, int samples, int bounces, const Vec3d& horizon, const Color& zenith) {
  scene.background = horizon;
  return film_of(scene, samples, bounces,
                 {.kind = TransportKind::paths, .has_sky = true, .has_gradient = true, .zenith = zenith, .up = {0, 0, 1}});
}

void add_boxes(Model& model, const Vec3d& one, const Microfacets& facets, const Vec3d& other) {
  model.fill(one, facets);
  model.box({.9, 1.2, 0}, {1.7, 2, .5});
  model.fill(other);
  model.box({2.4, 2.2, 0}, {3.1, 2.9, .35});
  model.shine({70, 60, 50});
  model.face({{1, 2.5, 6}, {3.2, 2.5, 6}, {3.2, 4.5, 6}, {1, 4.5, 6}});
}

/// Rough copper below matt boxes.
Model forge() {
  Model model({2, -1.2, 7}, {2, 1.9, 0}, 30);
  model.fill({.95, .64, .54}, {.roughness = .45, .metallic = 1});
  model.floor(0, 4);
  add_boxes(model, {.7, .7, .3}, {}, {.3, .5, .8});
  return model;
}

/// Plastic of two kinds.
Model desk() {
  Model model({2, -1.5, 7}, {2, 1.9, 0}, 30);
  model.fill({.15, .35, .6}, {.roughness = .5});
  model.floor(0, 4);
  add_boxes(model, {.7, .2, .1}, {.roughness = .3}, {.6, .6, .6});
  return model;
}

}  // namespace

TEST_CASE("a corner under a white sky is as bright as Cycles has it after three bounces") {
  check(under_sky(corner().scene(), samples, 3, {1, 1, 1}, {1, 1, 1}), {{{1.00000, 1.00000, 1.00000},
                                                                         {0.97844, 0.97108, 0.96782},
                                                                         {0.95293, 0.96995, 0.95680},
                                                                         {0.97231, 0.98420, 0.97526},
                                                                         {0.83468, 0.64787, 0.62941},
                                                                         {0.43662, 0.18278, 0.15512},
                                                                         {0.22586, 0.42778, 0.32330},
                                                                         {0.24244, 0.54815, 0.31908},
                                                                         {0.86698, 0.75273, 0.74241},
                                                                         {0.54650, 0.42593, 0.45988},
                                                                         {0.54248, 0.56383, 0.65580},
                                                                         {0.59286, 0.69731, 0.62181},
                                                                         {1.00000, 1.00000, 1.00000},
                                                                         {0.99853, 0.99839, 0.99842},
                                                                         {0.96397, 0.96297, 0.96310},
                                                                         {0.96693, 0.96701, 0.96671}}});
}

TEST_CASE("a court under a sky of two colours is as bright as Cycles has it after six bounces") {
  check(under_sky(court().scene(), samples, 6, {1, .8, .6}, {.2F, .4F, 1}), {{{0.15163, 0.11260, 0.15213},
                                                                              {0.15127, 0.16268, 0.24712},
                                                                              {0.14470, 0.17195, 0.25381},
                                                                              {0.11418, 0.16644, 0.19152},
                                                                              {0.14268, 0.09866, 0.13190},
                                                                              {0.15092, 0.17084, 0.28073},
                                                                              {0.14114, 0.18423, 0.28996},
                                                                              {0.09925, 0.16213, 0.17978},
                                                                              {0.13629, 0.09523, 0.13234},
                                                                              {0.13834, 0.15750, 0.27236},
                                                                              {0.12885, 0.17040, 0.28153},
                                                                              {0.09527, 0.15568, 0.18007},
                                                                              {0.11952, 0.09037, 0.16193},
                                                                              {0.11409, 0.12384, 0.25298},
                                                                              {0.10940, 0.13008, 0.25923},
                                                                              {0.09139, 0.13135, 0.19914}}});
}

TEST_CASE("steps under a sky of two colours are as bright as Cycles has them after one bounce") {
  check(under_sky(steps().scene(), samples, 1, {1, .9, .7}, {.3F, .5F, .9F}), {{{0.79355, 0.73572, 0.62023},
                                                                                {0.82443, 0.76029, 0.63217},
                                                                                {0.85537, 0.78489, 0.64411},
                                                                                {0.88631, 0.80950, 0.65606},
                                                                                {0.26395, 0.31347, 0.41321},
                                                                                {0.35678, 0.30941, 0.30417},
                                                                                {0.36845, 0.31276, 0.29773},
                                                                                {0.27670, 0.31253, 0.39770},
                                                                                {0.26742, 0.28992, 0.35954},
                                                                                {0.34920, 0.29627, 0.28261},
                                                                                {0.35585, 0.30045, 0.28464},
                                                                                {0.24233, 0.27823, 0.35977},
                                                                                {0.25828, 0.30736, 0.40708},
                                                                                {0.25184, 0.29791, 0.39438},
                                                                                {0.25813, 0.29186, 0.37457},
                                                                                {0.25638, 0.30482, 0.40357}}});
}

TEST_CASE("an arcade under a sky of two colours is as bright as Cycles has it after four bounces") {
  check(under_sky(arcade().scene(), samples, 4, {.9, .9, 1}, {.4F, .6F, 1}), {{{0.72165, 0.77984, 0.95766},
                                                                               {0.71713, 0.77711, 0.95762},
                                                                               {0.71713, 0.77710, 0.95759},
                                                                               {0.72177, 0.77995, 0.95776},
                                                                               {0.38240, 0.43242, 0.55061},
                                                                               {0.29102, 0.31087, 0.36898},
                                                                               {0.29132, 0.31105, 0.36904},
                                                                               {0.38282, 0.43273, 0.55081},
                                                                               {0.32236, 0.37857, 0.51251},
                                                                               {0.27510, 0.28134, 0.32851},
                                                                               {0.27514, 0.28126, 0.32832},
                                                                               {0.32215, 0.37838, 0.51234},
                                                                               {0.34695, 0.43129, 0.61707},
                                                                               {0.34256, 0.42515, 0.60701},
                                                                               {0.34270, 0.42524, 0.60702},
                                                                               {0.34698, 0.43128, 0.61698}}});
}

TEST_CASE("a room below a panel that shines is as bright as Cycles has it after four bounces") {
  check(film_of(vault().scene(), samples, 4, {.kind = TransportKind::paths}), {{{0.07475, 0.04374, 0.03167},
                                                                                {0.79929, 0.69265, 0.49770},
                                                                                {0.79035, 0.69686, 0.49537},
                                                                                {0.05280, 0.06340, 0.03562},
                                                                                {0.19751, 0.06093, 0.03449},
                                                                                {0.22668, 0.18261, 0.13452},
                                                                                {0.19666, 0.18467, 0.11478},
                                                                                {0.07357, 0.15480, 0.05937},
                                                                                {0.18179, 0.06204, 0.03695},
                                                                                {0.05592, 0.04138, 0.03761},
                                                                                {0.24806, 0.23252, 0.15139},
                                                                                {0.10267, 0.17678, 0.07755},
                                                                                {0.10207, 0.07397, 0.05137},
                                                                                {0.11309, 0.09486, 0.06626},
                                                                                {0.14547, 0.13197, 0.09053},
                                                                                {0.10753, 0.10746, 0.06883}}});
}

TEST_CASE("steps between a small bright box and a large dim panel are as bright as Cycles has them after two bounces") {
  check(film_of(lit_steps().scene(), samples, 2, {.kind = TransportKind::paths}), {{{0.00003, 0.00002, 0.00002},
                                                                                    {0.00003, 0.00002, 0.00002},
                                                                                    {0.00001, 0.00001, 0.00001},
                                                                                    {0.00000, 0.00000, 0.00000},
                                                                                    {0.00188, 0.00130, 0.00076},
                                                                                    {0.07306, 0.04036, 0.02351},
                                                                                    {0.07100, 0.06540, 0.07725},
                                                                                    {0.06590, 0.12121, 0.23006},
                                                                                    {3.24911, 2.14931, 1.07023},
                                                                                    {0.28222, 0.14472, 0.06509},
                                                                                    {0.12300, 0.10783, 0.12513},
                                                                                    {0.07266, 0.13957, 0.27166},
                                                                                    {0.26193, 0.17733, 0.09688},
                                                                                    {0.15054, 0.10493, 0.06655},
                                                                                    {0.04887, 0.03930, 0.03827},
                                                                                    {0.02775, 0.03894, 0.06512}}});
}

TEST_CASE("rough copper below a panel that shines is as bright as Cycles has it after two bounces") {
  check(film_of(forge().scene(), samples, 2, {.kind = TransportKind::paths}), {{{0.57318, 0.33096, 0.23266},
                                                                                {1.27767, 0.73775, 0.51866},
                                                                                {1.31198, 0.76576, 0.54706},
                                                                                {0.63182, 0.36565, 0.25796},
                                                                                {1.81939, 1.07146, 0.73078},
                                                                                {4.23287, 2.54795, 1.67965},
                                                                                {3.50334, 2.27328, 1.86286},
                                                                                {1.98372, 1.17779, 0.86235},
                                                                                {2.24318, 1.33067, 0.89703},
                                                                                {4.36694, 2.66712, 1.71168},
                                                                                {8.99052, 5.19107, 3.64926},
                                                                                {3.35131, 1.93517, 1.36063},
                                                                                {1.80978, 1.04498, 0.73469},
                                                                                {4.40525, 2.54361, 1.78829},
                                                                                {4.65630, 2.68865, 1.89030},
                                                                                {2.05562, 1.18698, 0.83456}}});
}

TEST_CASE("rough plastic below a panel that shines is as bright as Cycles has it") {
  check(film_of(desk().scene(), samples, 0, {.kind = TransportKind::paths}), {{{0.18365, 0.34104, 0.47548},
                                                                               {0.28696, 0.51803, 0.71509},
                                                                               {0.29150, 0.52503, 0.72416},
                                                                               {0.19065, 0.35266, 0.49102},
                                                                               {0.41051, 0.61609, 0.82455},
                                                                               {0.90589, 0.86814, 1.02716},
                                                                               {0.86329, 0.94544, 1.00190},
                                                                               {0.39801, 0.64549, 0.85492},
                                                                               {0.43105, 0.56068, 0.72313},
                                                                               {0.95121, 0.65587, 0.64673},
                                                                               {0.58884, 0.86016, 1.08706},
                                                                               {0.40594, 0.66675, 0.88771},
                                                                               {0.26673, 0.44750, 0.60092},
                                                                               {0.36369, 0.54914, 0.70491},
                                                                               {0.37253, 0.55858, 0.71472},
                                                                               {0.27967, 0.46363, 0.61960}}});
}

}  // namespace cycles_test
