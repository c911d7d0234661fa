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

// From the root triangle down to smaller and smaller elements that hold one of its points, with
// nothing for a processor to guess: which part a point is in is as good as chance.
class WayDown {
 public:
  WayDown() = default;
  WayDown(double u, double v) : x_(u), y_(v) {}
  // Into the part of the present element that holds the point: its number.
  int next() {
    const double x = from_ + towards_ * x_, y = from_ + towards_ * y_;
    const int at_second = x > 0.5, at_third = y > 0.5, in_middle = !(x + y < 0.5);
    const int part = at_second + (1 - at_second) * (2 * at_third + 3 * (1 - at_third) * in_middle);
    const int upright = towards_ > 0;
    // What part_of() adds to i and j; all of this is exact.
    x_ = 2 * x_ - ((part == 1) == upright);
    y_ = 2 * y_ - ((part == 2) == upright);
    const double turn = 1 - 2 * (part == 3);
    towards_ *= turn;
    from_ = (1 - towards_) / 2;
    return part;
  }

 private:
  double x_ = 0, y_ = 0;           // as if the present element stood upright, measured from (i,j)
  double from_ = 0, towards_ = 1;  // of an inverted one: 1 and -1
};

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
