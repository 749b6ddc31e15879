// SPDX-License-Identifier: Apache-2.0
#include "naive_shader.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include "base/units.h"
#include "render/gl/gl_object.h"

namespace sonar::bench {
namespace {

constexpr int kTessels = 24;

const char* const kHullVertex = R"(#version 410 core
layout(location = 0) in vec3 place;
uniform vec3 eye, right, up, forward;
uniform vec2 tan_half;
out vec3 seen;
void main() {
  seen = place - eye;
  float depth = dot(seen, forward);
  gl_Position = vec4(dot(seen, right) / tan_half.x, dot(seen, up) / tan_half.y, 0.0, depth);
}
)";

const char* const kHullFragment = R"(#version 410 core
in vec3 seen;
layout(location = 0) out vec4 distance_m;
void main() { distance_m = vec4(length(seen)); }
)";

const char* const kWholeVertex = R"(#version 410 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)";

const char* const kRayFragment = R"(#version 410 core
uniform sampler3D volume;
uniform sampler2D table, near_m, far_m;
uniform vec3 eye, right, up, forward, size;
uniform vec2 tan_half, resolution, range_axis, azimuth_axis, elevation_axis;
uniform float step_m;
uniform int inside;
layout(location = 0) out vec4 colour;
void main() {
  vec2 q = (gl_FragCoord.xy / resolution * 2.0 - 1.0) * tan_half;
  vec3 d = normalize(forward + q.x * right + q.y * up);
  ivec2 at = ivec2(gl_FragCoord.xy);
  float t1 = texelFetch(far_m, at, 0).r;
  float t0 = inside == 1 ? 0.0 : texelFetch(near_m, at, 0).r;
  if (t1 <= t0) {
    colour = vec4(0.0);
    return;
  }
  vec3 sum = vec3(0.0);
  float through = 1.0;
  for (float t = t0 + 0.5 * step_m; t < t1; t += step_m) {
    vec3 p = eye + t * d;
    float r = length(p);
    float azimuth = atan(p.y, p.x);
    float inclination = acos(p.z / r);
    vec3 g = vec3((r - range_axis.x) / range_axis.y, (azimuth - azimuth_axis.x) / azimuth_axis.y,
                  (1.57079633 - inclination - elevation_axis.x) / elevation_axis.y);
    if (any(lessThan(g, vec3(0.0))) || any(greaterThan(g, vec3(1.0)))) continue;
    float s = texture(volume, (g * (size - 1.0) + 0.5) / size).r;
    float entries = float(textureSize(table, 0).x);
    vec4 k = texture(table, vec2((s * (entries - 1.0) + 0.5) / entries, 0.5));
    float a = 1.0 - exp(-k.a * step_m);
    sum += through * a * k.rgb;
    through *= 1.0 - a;
    if (through < 0.01) break;
  }
  colour = vec4(sum, 1.0);
}
)";

using Vertex = std::array<float, 3>;

Vertex vertex(const Sector& sector, double fan, double beam, double range_m) {
  const auto mixed = [](double low, double high, double part) { return low + (high - low) * part; };
  const double elevation = mixed(sector.elevation_rad(0), sector.elevation_rad(sector.fans() - 1), fan);
  const double azimuth = mixed(sector.azimuth_rad(0), sector.azimuth_rad(sector.beams() - 1), beam);
  const Point<Sonar> p = Sector::direction(elevation, azimuth) * range_m;
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// Five faces: the outer sphere, the two fans and the two vertical planes at the ends; two parameters 0..1 each.
Vertex on_face(const Sector& sector, int face, double a, double b) {
  const double far_m = sector.range().range_m(sector.range().count - 1);
  switch (face) {
    case 0:
      return vertex(sector, a, b, far_m);
    case 1:
      return vertex(sector, 0.0, a, b * far_m);
    case 2:
      return vertex(sector, 1.0, a, b * far_m);
    case 3:
      return vertex(sector, a, 0.0, b * far_m);
    default:
      return vertex(sector, a, 1.0, b * far_m);
  }
}

std::vector<Vertex> hull(const Sector& sector) {
  std::vector<Vertex> out;
  const double n = kTessels;
  for (int face = 0; face < 5; ++face) {
    for (int i = 0; i < kTessels; ++i) {
      for (int j = 0; j < kTessels; ++j) {
        const auto corner = [&](int di, int dj) { return on_face(sector, face, (i + di) / n, (j + dj) / n); };
        out.insert(out.end(), {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 0), corner(1, 1), corner(0, 1)});
      }
    }
  }
  return out;
}

Texture texture_2d(PixelSize size, GLint internal, const void* data, GLint filter) {
  Texture out = Texture::make();
  glBindTexture(GL_TEXTURE_2D, out.id());
  glTexImage2D(GL_TEXTURE_2D, 0, internal, size.width, size.height, 0, GL_RGBA, GL_FLOAT, data);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return out;
}

/// Sv as part of the table's way, fans turned so that the depression rises.
Texture volume_texture(const VolumeData& volume, const OpticalTable& table) {
  const Shape3 shape = volume.sv.shape();
  std::vector<float> values(shape.size());
  std::size_t i = 0;
  for (int fan = shape.fans - 1; fan >= 0; --fan) {
    for (int beam = 0; beam < shape.beams; ++beam) {
      for (const std::int16_t counts : volume.sv.row(fan, beam)) {
        values[i++] = static_cast<float>((db_from_counts(counts) - table.first_db) / (table.last_db - table.first_db));
      }
    }
  }
  Texture out = Texture::make();
  glBindTexture(GL_TEXTURE_3D, out.id());
  glTexImage3D(GL_TEXTURE_3D, 0, GL_R32F, shape.samples, shape.beams, shape.fans, 0, GL_RED, GL_FLOAT, values.data());
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  for (const GLenum axis : std::initializer_list<GLenum>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    glTexParameteri(GL_TEXTURE_3D, axis, GL_CLAMP_TO_EDGE);
  }
  return out;
}

Framebuffer target(const Texture& texture) {
  Framebuffer out = Framebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, out.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  return out;
}

void set3(const Program& program, const char* name, const Point<Sonar>& p) {
  glUniform3f(glGetUniformLocation(program.id(), name), static_cast<float>(p.x), static_cast<float>(p.y),
              static_cast<float>(p.z));
}

void set2(const Program& program, const char* name, double x, double y) {
  glUniform2f(glGetUniformLocation(program.id(), name), static_cast<float>(x), static_cast<float>(y));
}

void set_camera(const Program& program, const CameraBasis& camera) {
  glUseProgram(program.id());
  set3(program, "eye", camera.eye);
  set3(program, "right", camera.right);
  set3(program, "up", camera.up);
  set3(program, "forward", camera.forward);
  set2(program, "tan_half", camera.tan_half_fov * camera.size.width / camera.size.height, camera.tan_half_fov);
}

double cpu_now() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

bool inside_sector(const Sector& sector, const Point<Sonar>& p) {
  const SectorIndex at = sector.index_of(p);
  return at.fan >= 0 && at.fan <= sector.fans() - 1 && at.beam >= 0 && at.beam <= sector.beams() - 1 &&
         at.sample >= 0 && at.sample <= sector.range().count - 1;
}

void set_axes(const Program& program, const Sector& sector) {
  const RangeAxis range = sector.range();
  const double last_el = sector.elevation_rad(sector.fans() - 1);
  set2(program, "range_axis", range.first_m, range.spacing_m * (range.count - 1));
  set2(program, "azimuth_axis", sector.azimuth_rad(0), sector.azimuth_rad(sector.beams() - 1) - sector.azimuth_rad(0));
  set2(program, "elevation_axis", -last_el, last_el - sector.elevation_rad(0));
  glUniform3f(glGetUniformLocation(program.id(), "size"), static_cast<float>(range.count),
              static_cast<float>(sector.beams()), static_cast<float>(sector.fans()));
}

void read_back(PixelSize size, RayImage& out) {
  std::vector<std::array<float, 4>> rows(size.count());
  glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_FLOAT, rows.data());
  out.size = size;
  out.rgba.resize(size.count());
  const auto width = static_cast<std::ptrdiff_t>(size.width);
  for (int y = 0; y < size.height; ++y) {
    std::copy_n(rows.begin() + (size.height - 1 - y) * width, width, out.rgba.begin() + y * width);
  }
}

/// Everything the frames share; draw() is one of them.
struct Scene {
  Program hull, rays;
  Buffer vertices;
  VertexArray shape, none;
  Texture volume, table, near_m, far_m, colour;
  Framebuffer near_target, far_target, target;
  GLsizei count = 0;
  bool inside = false;

  void span(const Framebuffer& into, GLenum equation, float clear) const {
    glBindFramebuffer(GL_FRAMEBUFFER, into.id());
    glClearColor(clear, clear, clear, clear);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glBlendEquation(equation);
    glUseProgram(hull.id());
    glBindVertexArray(shape.id());
    glDrawArrays(GL_TRIANGLES, 0, count);
    glDisable(GL_BLEND);
  }

  void draw() const {
    span(far_target, GL_MAX, 0.0F);
    if (!inside) {
      span(near_target, GL_MIN, 1e9F);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    glUseProgram(rays.id());
    const std::array<std::pair<GLenum, const Texture*>, 4> units = {
        {{GL_TEXTURE_3D, &volume}, {GL_TEXTURE_2D, &table}, {GL_TEXTURE_2D, &near_m}, {GL_TEXTURE_2D, &far_m}}};
    for (std::size_t i = 0; i < units.size(); ++i) {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
      glBindTexture(units[i].first, units[i].second->id());
    }
    glBindVertexArray(none.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
  }
};

void set_scene(Scene& scene, const VolumeData& volume, const OpticalTable& table, const VolumeView& view) {
  const PixelSize size = view.size;
  scene.volume = volume_texture(volume, table);
  scene.table = texture_2d({static_cast<int>(table.rgb_extinction.size()), 1}, GL_RGBA32F, table.rgb_extinction.data(),
                           GL_LINEAR);
  scene.near_m = texture_2d(size, GL_R32F, nullptr, GL_NEAREST);
  scene.far_m = texture_2d(size, GL_R32F, nullptr, GL_NEAREST);
  scene.colour = texture_2d(size, GL_RGBA8, nullptr, GL_NEAREST);
  scene.near_target = target(scene.near_m);
  scene.far_target = target(scene.far_m);
  scene.target = target(scene.colour);
  scene.shape = VertexArray::make();
  scene.none = VertexArray::make();
  scene.vertices = Buffer::make();
  const std::vector<Vertex> mesh = hull(volume.sector);
  scene.count = static_cast<GLsizei>(mesh.size());
  glBindVertexArray(scene.shape.id());
  glBindBuffer(GL_ARRAY_BUFFER, scene.vertices.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.size() * sizeof(Vertex)), mesh.data(), GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  scene.inside = inside_sector(volume.sector, view.camera.eye);
}

void set_uniforms(const Scene& scene, const VolumeData& volume, const VolumeView& view, double step_m) {
  const CameraBasis camera = basis(view.camera, view.size);
  set_camera(scene.hull, camera);
  set_camera(scene.rays, camera);
  set_axes(scene.rays, volume.sector);
  set2(scene.rays, "resolution", view.size.width, view.size.height);
  glUniform1f(glGetUniformLocation(scene.rays.id(), "step_m"), static_cast<float>(step_m));
  glUniform1i(glGetUniformLocation(scene.rays.id(), "inside"), scene.inside ? 1 : 0);
  int unit = 0;
  for (const char* name : {"volume", "table", "near_m", "far_m"}) {
    glUniform1i(glGetUniformLocation(scene.rays.id(), name), unit++);
  }
}

}  // namespace

double naive_frame(const VolumeData& volume, const OpticalTable& table, const VolumeView& view, double step_m,
                   int frames, NaiveFrame& out) {
  auto hull_program = make_program("naive hull", {kHullVertex, kHullFragment});
  auto rays_program = make_program("naive rays", {kWholeVertex, kRayFragment});
  if (!hull_program || !rays_program) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  Scene scene;
  scene.hull = std::move(*hull_program);
  scene.rays = std::move(*rays_program);
  for (const GLenum state :
       std::initializer_list<GLenum>{GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST}) {
    glDisable(state);
  }
  set_scene(scene, volume, table, view);
  set_uniforms(scene, volume, view, step_m);
  glViewport(0, 0, view.size.width, view.size.height);
  scene.draw();
  out.wall_s = std::numeric_limits<double>::infinity();
  const double cpu_before = cpu_now();
  for (int i = 0; i < frames; ++i) {
    const auto before = std::chrono::steady_clock::now();
    scene.draw();
    out.wall_s = std::min(out.wall_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
  }
  out.cpu_s = (cpu_now() - cpu_before) / std::max(frames, 1);
  read_back(view.size, out.picture);
  return glGetError() == GL_NO_ERROR ? out.wall_s : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace sonar::bench
