// The table of the paper's Fig. 2c: seconds on so many nodes with so many threads each. A node has
// eight cores: its sixteen threads share them.
#pragma once

#include <string>

namespace bench {

struct PaperRow {
  int nodes, threads;
  double building, classroom;  // seconds
};

constexpr PaperRow kPaperTable[] = {
    {1, 1, 42.91, 1813.99}, {1, 2, 21.76, 965.86},  {1, 4, 11.95, 487.90}, {1, 8, 6.52, 256.54},
    {1, 16, 5.25, 194.47},  {2, 1, 24.16, 1114.30}, {2, 2, 12.88, 531.86}, {2, 4, 6.90, 297.38},
    {2, 8, 3.86, 155.91},   {2, 16, 3.05, 139.10},  {4, 1, 12.86, 716.02}, {4, 2, 6.84, 357.08},
    {4, 4, 3.70, 190.34},   {4, 8, 2.11, 119.03},   {4, 16, 1.78, 102.66}, {8, 1, 6.60, 488.94},
    {8, 2, 3.45, 260.25},   {8, 4, 1.89, 132.22},   {8, 8, 1.25, 69.96},   {8, 16, 1.15, 61.91}};

// Negative where the paper has none.
inline double paper_seconds(const std::string& scene, int nodes, int threads) {
  for (const PaperRow& row : kPaperTable)
    if (row.nodes == nodes && row.threads == threads)
      return scene == "building" ? row.building : scene == "classroom" ? row.classroom : -1;
  return -1;
}

}  // namespace bench
