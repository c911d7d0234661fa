// hrad query. CLI: public headers only.
#include <algorithm>
#include <numeric>

#include "command.h"
#include "exit_code.h"
#include "json.h"
#include "numbers.h"
#include "output_files.h"
#include "quantity.h"
#include "render/grid_picture.h"
#include "render/png_file.h"
#include "run_options.h"
#include "sensors.h"
#include "session.h"
#include "signals.h"
#include "solve_report.h"

namespace hrad::cli {
namespace {

struct Request {
  bool patches = false, as_json = false, as_csv = false;
  std::vector<std::string> at, sensor_files, grids;
  std::optional<std::string> quantity_name;
  Quantity quantity;
  Sensors sensors;
  std::optional<SensorGrid> grid;  // of which a picture is wanted

  bool asks_for_sensors() const { return !at.empty() || !sensor_files.empty() || !grids.empty(); }
};

void add_to(Arguments* parser, Request* request) {
  parser->add_flag("--patches", &request->patches,
                   "Means over the patches, per side (this is what is printed by default)");
  parser->add_list("--at", "X,Y,Z:NX,NY,NZ", &request->at, "Irradiance at a point with a normal");
  parser->add_list("--sensors", "FILE", &request->sensor_files,
                   "Irradiance at points of a file, - for stdin: X Y Z NX NY NZ a line");
  parser->add_list("--grid", "X0,Y0,Z0:X1,Y1,Z1:NxM", &request->grids,
                   "Irradiance at the centres of N x M cells of a rectangle");
  parser->add_option("--quantity", "Q", &request->quantity_name,
                     "Of patches: radiosity (the default), irradiance, emission or net_flux");
  parser->add_flag("--json", &request->as_json, "Print one JSON object");
  parser->add_flag("--csv", &request->as_csv, "Print a table with a header (the default)");
  parser->exclude("--json", "--csv");
}

constexpr const char* notes =
    "The corners of --grid are opposite ones and must have exactly one coordinate in common: the\n"
    "normal points along that coordinate, in its positive direction. N counts cells along the\n"
    "first of the other two coordinates, which runs fastest, M along the second.\n"
    "-o FILE.png also draws a grid, in false colours of the sum of the bands.\n"
    "In a file of sensors, numbers are separated by blanks or commas, and # begins a comment.\n"
    "Values are in W/m2 per band.\n"
    "\n"
    "Example: hrad query furnace --grid 0,0.5,0:1,0.5,1:8x8 --json";

void resolve(Request* request, bool wants_picture) {
  if (wants_picture && (request->grids.size() != 1 || !request->at.empty() ||
                        !request->sensor_files.empty() || request->patches))
    fail_usage("query", "-o makes a picture of one --grid and nothing else");
  if (request->quantity_name) request->quantity = read_quantity(*request->quantity_name, "query");
  if (!request->asks_for_sensors()) request->patches = true;
  if (request->patches && request->asks_for_sensors() && !request->as_json)
    fail_usage("query", "patches and points are two tables: ask for one, or for --json");
  if (!request->patches && request->quantity_name && request->quantity.number != HRAD_IRRADIANCE)
    fail_usage("query", "at points there is irradiance alone; --quantity is for --patches");
  for (const std::string& text : request->at) add_sensor(text, &request->sensors);
  for (const std::string& path : request->sensor_files) add_sensor_file(path, &request->sensors);
  for (const std::string& text : request->grids) {
    const SensorGrid grid = add_sensor_grid(text, &request->sensors);
    if (wants_picture) request->grid = grid;
  }
  if (request->grid) check_grid_for_picture(*request->grid);
}

void append_header(std::string* text, const char* columns, std::initializer_list<const char*> names,
                   size_t bands) {
  *text += columns;
  for (const char* name : names)
    for (size_t band = 0; band < bands; ++band) {
      *text += name;
      append_integer(text, static_cast<int64_t>(band));
    }
  *text += '\n';
}

void append_values(std::string* text, const double* values, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (!text->empty() && text->back() != '\n') *text += ',';
    append_real(text, values[i]);
  }
}

void append_patch_side(Output* output, JsonWriter* json, int64_t number, const hrad_patch& patch,
                       int32_t side, const double* values, size_t bands) {
  if (json != nullptr) {
    json->begin_object(JsonWriter::one_line);
    json->field("patch", number);
    json->field("face", patch.face);
    json->field("side", side);
    json->field("area", patch.area);
    json->field("values", values, static_cast<int64_t>(bands));
    json->end();
  } else {
    std::string& text = output->text();
    for (int64_t head : {number, patch.face, static_cast<int64_t>(side)}) {
      append_integer(&text, head);
      text += ',';
    }
    append_real(&text, patch.area);
    append_values(&text, values, bands);
    text += '\n';
  }
  output->relieve();
}

// One row per patch and side; one-sided patches have no second row.
void append_patches(Session* session, const Request& request, Output* output, JsonWriter* json) {
  const auto bands = static_cast<size_t>(session->bands());
  if (json == nullptr) append_header(&output->text(), "patch,face,side,area", {",b"}, bands);
  constexpr int64_t most_at_once = 65536;
  const int64_t patches = session->patches();
  std::vector<double> values[2];
  for (int64_t first = 0; first < patches; first += most_at_once) {
    const int64_t count = std::min(most_at_once, patches - first);
    for (int32_t side : {HRAD_FRONT, HRAD_BACK}) {
      values[side].resize(static_cast<size_t>(count) * bands);
      check(hrad_query_patches(session->solver(), request.quantity.number, side, first, count,
                               values[side].data()));
    }
    for (int64_t i = 0; i < count; ++i) {
      hrad_patch patch{};
      patch.struct_size = sizeof patch;
      check(hrad_get_patch(session->solver(), first + i, &patch));
      const int32_t sides = patch.flags & HRAD_PATCH_TWO_SIDED ? 2 : 1;
      for (int32_t side = 0; side < sides; ++side)
        append_patch_side(output, json, first + i, patch, side,
                          &values[side][static_cast<size_t>(i) * bands], bands);
    }
    signals::check();
  }
}

// Returns the sums over the bands.
std::vector<double> append_sensors(Session* session, const Sensors& sensors, Output* output,
                                   JsonWriter* json) {
  const auto bands = static_cast<size_t>(session->bands());
  if (json == nullptr)
    append_header(&output->text(), "x,y,z,nx,ny,nz", {",irradiance", ",standard_error"}, bands);
  std::vector<double> sums;
  // Few at a time, so that a signal needn't wait long.
  constexpr int64_t most_at_once = 1024;
  std::vector<double> irradiance(most_at_once * bands), standard_error(most_at_once * bands);
  for (int64_t first = 0; first < sensors.count(); first += most_at_once) {
    const int64_t count = std::min(most_at_once, sensors.count() - first);
    const double* xyz = &sensors.xyz[static_cast<size_t>(3 * first)];
    const double* normal = &sensors.normal[static_cast<size_t>(3 * first)];
    check(hrad_query_sensors(session->solver(), count, xyz, normal, irradiance.data(),
                             standard_error.data()));
    for (size_t i = 0; i < static_cast<size_t>(count); ++i) {
      sums.push_back(std::accumulate(&irradiance[i * bands], &irradiance[i * bands] + bands, 0.0));
      if (json != nullptr) {
        json->begin_object(JsonWriter::one_line);
        json->field("position", xyz + 3 * i, 3);
        json->field("normal", normal + 3 * i, 3);
        json->field("irradiance", &irradiance[i * bands], static_cast<int64_t>(bands));
        json->field("standard_error", &standard_error[i * bands], static_cast<int64_t>(bands));
        json->end();
      } else {
        append_values(&output->text(), xyz + 3 * i, 3);
        append_values(&output->text(), normal + 3 * i, 3);
        append_values(&output->text(), &irradiance[i * bands], bands);
        append_values(&output->text(), &standard_error[i * bands], bands);
        output->text() += '\n';
      }
      output->relieve();
    }
    signals::check();
  }
  return sums;
}

std::vector<double> append_json(Session* session, const std::string& scene, bool solved,
                                const Request& request, Output* output) {
  std::vector<double> sums;
  JsonWriter json(&output->text());
  json.begin_object();
  json.field("scene", scene);
  if (solved) json.field("state_hash", hash_text(session->solver()));
  if (request.patches) {
    json.field("quantity", request.quantity.name);
    json.begin_array("patches");
    append_patches(session, request, output, &json);
    json.end();
  }
  if (request.asks_for_sensors()) {
    json.begin_array("sensors");
    sums = append_sensors(session, request.sensors, output, &json);
    json.end();
  }
  json.end();
  return sums;
}

}  // namespace

int run_query(const std::vector<std::string>& arguments, Output* output) {
  RunOptions options;
  OutputFiles files(OutputFiles::pictures);
  Request request;
  Arguments parser("query", "Solve a scene and print values at patches, points or grids.", notes);
  options.add_to(&parser, "query", RunOptions::a_scene_to_solve);
  files.add_to(&parser, "query");
  add_to(&parser, &request);
  if (!parser.parse(arguments, &output->text())) return 0;
  if (!options.check()) return exit_done;
  if (files.paths().size() > 1) fail_usage("query", "-o is given more than once");
  resolve(&request, !files.paths().empty());
  files.check(options.scene_is_file() ? options.scene() : "");

  Session session(options);
  session.load();
  // Emission is known without a solve.
  const bool solves = request.asks_for_sensors() || request.quantity.number != HRAD_EMISSION;
  const int code = solves ? session.solve() : 0;
  std::vector<double> sums;
  if (request.as_json)
    sums = append_json(&session, options.scene(), solves, request, output);
  else if (request.patches)
    append_patches(&session, request, output, nullptr);
  else
    sums = append_sensors(&session, request.sensors, output, nullptr);
  if (request.grid)
    write_png(make_grid_picture(*request.grid, sums, static_cast<size_t>(session.bands())),
              files.paths().front());
  return code;
}

}  // namespace hrad::cli
