// An element or a cluster as a stage looks at it, and the lattice place that names an element's
// shape. Floor 5 (hierarchy).
#pragma once

#include <cstddef>
#include <cstdint>

namespace hrad {

// An index into Forest::nodes. The first ones are the roots; the clusters follow, if there are any,
// and then the elements, parents before children.
using NodeId = int32_t;

constexpr int max_level = 15;  // lattice coordinates of an element fit into 16 bits

// MEMORY when so many nodes are more than have numbers.
void require_numbers(size_t nodes);

// Where the direct light of a leaf is known (linking=rows).
enum LightPoints : uint8_t {
  at_corners,
  half_way_to_the_middle,  // from the corners
  at_own_points,           // of its exposed part
};

// A triangle of the lattice that L subdivisions draw on a patch: with the point of coordinates
// (i,j) at u = i/2^L, v = j/2^L, an upright one has the corners (i,j), (i+1,j), (i,j+1), an
// inverted one (i+1,j+1), (i,j+1), (i+1,j). So an element needs no corners of its own, and
// neighbours share exactly the same ones.
struct LatticePlace {
  uint16_t i = 0, j = 0;
  uint8_t level = 0;
  uint8_t inverted = 0;
};

// One of the four parts; 3 is the one in the middle.
inline LatticePlace part_of(const LatticePlace& whole, int part) {
  LatticePlace place;
  place.level = static_cast<uint8_t>(whole.level + 1);
  // Upright: the corners in order are (i,j), (i+1,j), (i,j+1), and the one in the middle stands
  // inverted. Inverted: (i+1,j+1), (i,j+1), (i+1,j), and it stands upright.
  const int i = whole.inverted ? part != 1 : part == 1;
  const int j = whole.inverted ? part != 2 : part == 2;
  place.i = static_cast<uint16_t>(2 * whole.i + i);
  place.j = static_cast<uint16_t>(2 * whole.j + j);
  place.inverted = static_cast<uint8_t>((part == 3) != (whole.inverted != 0));
  return place;
}

// From (u,v) of the root triangle to (x,y) within an element, measured from its first corner, and
// back.
inline void element_coordinates(const LatticePlace& n, double u, double v, double* x, double* y) {
  const double scale = static_cast<double>(1 << n.level);
  *x = u * scale - n.i;
  *y = v * scale - n.j;
  if (n.inverted) {
    *x = 1 - *x;
    *y = 1 - *y;
  }
}
inline void root_coordinates(const LatticePlace& n, double x, double y, double* u, double* v) {
  const double scale = static_cast<double>(1 << n.level);
  *u = (n.i + (n.inverted ? 1 - x : x)) / scale;
  *v = (n.j + (n.inverted ? 1 - y : y)) / scale;
}
// The part that holds a point of the root triangle.
inline int part_at(const LatticePlace& n, double u, double v) {
  double x, y;
  element_coordinates(n, u, v, &x, &y);
  return x > 0.5 ? 1 : y > 0.5 ? 2 : x + y < 0.5 ? 0 : 3;
}

// All of it, a value of its own. Of a cluster only parent, surface and exposed mean anything.
struct Node : LatticePlace {
  NodeId parent = -1;        // of a root the cluster that holds it
  NodeId first_child = -1;   // the four children stand side by side; -1: a leaf
  int32_t surface = 0;       // -1-c: cluster c
  uint8_t light_points = 0;  // LightPoints
  float exposed = 1;         // share of the area that is not sealed (design: the exposure rule)
};

// A leaf of the same surface, as exposed as its parent, which the caller has to name.
inline Node child_place(const Node& parent, int child) {
  Node node;
  static_cast<LatticePlace&>(node) = part_of(parent, child);
  node.surface = parent.surface;
  node.exposed = parent.exposed;
  return node;
}

}  // namespace hrad
