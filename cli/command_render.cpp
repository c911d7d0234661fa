// hrad render. CLI: public headers only.
#include <chrono>

#include "command.h"
#include "exit_code.h"
#include "json.h"
#include "numbers.h"
#include "output_files.h"
#include "render/png_file.h"
#include "render_options.h"
#include "run_options.h"
#include "session.h"
#include "solve_report.h"

namespace hrad::cli {
namespace {

constexpr const char* notes =
    "Without --eye the camera is chosen: inside a closed room, before an open scene. Backs of\n"
    "one-sided surfaces are black, as they are to light; when the eye lies outside the scene's\n"
    "box they are left out, so that one sees into a closed room. Three bands are red, green and\n"
    "blue; of any other number the mean is grey. --false-colour shows the sum of the bands; its\n"
    "range is that of the surfaces seen but for lamps, and --exposure divides it.\n"
    "\n"
    "Example: hrad render classroom -o classroom.png --exposure 0.5";

void append_vector(JsonWriter* json, const char* name, const Vector3& vector) {
  const double numbers[3] = {vector.x, vector.y, vector.z};
  json->field(name, numbers, 3);
}

void append_json(Session* session, const RunOptions& options, const std::string& path,
                 const Camera& camera, const PictureOptions& asked, const Picture& picture,
                 double seconds, Output* output) {
  JsonWriter json(&output->text());
  json.begin_object();
  json.field("scene", options.scene());
  json.field("state_hash", hash_text(session->solver()));
  json.field("file", path);
  json.field("width", static_cast<int64_t>(picture.image.width));
  json.field("height", static_cast<int64_t>(picture.image.height));
  json.begin_object("camera");
  append_vector(&json, "eye", camera.eye);
  append_vector(&json, "look", camera.look);
  append_vector(&json, "up", camera.up);
  json.field("fov", camera.fov);
  json.end();
  json.field("backs", picture.backs_hidden ? "hidden" : "black");
  json.field("exposure", asked.exposure);
  if (asked.false_colour) {
    json.field("quantity", asked.quantity_name);
    const double range[2] = {picture.range.low, picture.range.high};
    json.field("range", range, 2);
  } else {
    json.field("scale", picture.scale);
  }
  json.field("mesh", asked.mesh);
  json.field("seconds", seconds);
  json.end();
}

}  // namespace

int run_render(const std::vector<std::string>& arguments, Output* output) {
  RunOptions options;
  RenderOptions render;
  OutputFiles files(OutputFiles::pictures);
  bool as_json = false;
  Arguments parser("render", "Solve a scene and write a picture of it.", notes);
  options.add_to(&parser, "render", RunOptions::a_scene_to_solve);
  files.add_to(&parser, "render");
  render.add_to(&parser);
  parser.add_flag("--json", &as_json, "Print one JSON object: the camera, the exposure");
  if (!parser.parse(arguments, &output->text())) return 0;
  if (files.paths().empty()) fail_usage("render", "-o FILE.png is missing");
  if (files.paths().size() > 1) fail_usage("render", "-o is given more than once");
  if (!options.check()) return exit_done;
  render.check();
  files.check(options.scene_is_file() ? options.scene() : "");

  Session session(options);
  session.load();
  // The camera is found before the solve, so that one that can't be used costs no time.
  Geometry geometry = fetch_geometry(&session);
  const Camera camera = render.camera(geometry, session.stats().up_axis);
  const int code = session.solve();
  const auto start = std::chrono::steady_clock::now();
  const Picture picture = make_picture(&session, geometry, camera, render.picture());
  if (picture.dark && options.verbosity() != Verbosity::quiet)
    session.terminal().say(
        "warning: most of what the picture shows is black: backs of one-sided surfaces, or unlit; "
        "if surfaces are inside out, --flip or --two-sided helps");
  const std::string& path = files.paths().front();
  write_png(picture.image, path);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (as_json)
    append_json(&session, options, path, camera, render.picture(), picture, seconds, output);
  return code;
}

}  // namespace hrad::cli
