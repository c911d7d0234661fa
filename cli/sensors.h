// Where sensors stand: read from the command line (--at, --grid) and from files (--sensors). CLI:
// public headers only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hrad::cli {

struct Sensors {
  std::vector<double> xyz, normal;  // three each
  int64_t count() const { return static_cast<int64_t>(xyz.size() / 3); }
};

// What a grid looks like from the side that its normal points to.
struct SensorGrid {
  int64_t cells[2];  // along the two axes that the rectangle spans
  double extent[2];  // its lengths along them
  char normal_axis;  // 'x', 'y' or 'z'
  double level;      // where the rectangle lies along that axis
};

// X,Y,Z:NX,NY,NZ
void add_sensor(const std::string& text, Sensors* sensors);

// Six numbers a line, blanks or one comma between them; # begins a comment; "-" is stdin. Failure
// (input/output) names file:line.
void add_sensor_file(const std::string& path, Sensors* sensors);

// X0,Y0,Z0:X1,Y1,Z1:NxM: the rectangle between two opposite corners that have exactly one
// coordinate in common; the normal points along that coordinate. Sensors stand at the centres of N
// x M cells, N along the first of the other two coordinates, which runs fastest.
SensorGrid add_sensor_grid(const std::string& text, Sensors* sensors);

}  // namespace hrad::cli
