// Array by array. Floor 3 (scene).
#include "scene/scene_bytes.h"

#include "machine/sharing.h"

namespace hrad {
namespace {

// Goes through all that is to be told in one order, to put it into bytes or to take it out of them.
class Writer {
 public:
  explicit Writer(Bytes& bytes) : bytes_(bytes) {}
  template <class T>
  void value(T& v) {
    put(bytes_, &v, 1);
  }
  template <class List>
  void list(List& values) {
    put_list(bytes_, values);
  }
  template <class List>
  void resize(List& values) {
    const uint64_t size = values.size();
    put(bytes_, &size, 1);
  }

 private:
  Bytes& bytes_;
};

class Reader {
 public:
  explicit Reader(const Bytes& bytes) : taker_(bytes) {}
  template <class T>
  void value(T& v) {
    taker_.take(&v, 1);
  }
  template <class List>
  void list(List& values) {
    take_list(taker_, values);
  }
  template <class List>
  void resize(List& values) {
    uint64_t size;
    taker_.take(&size, 1);
    values.resize(size);
  }

 private:
  Taker taker_;
};

template <class Way>
void pass(Way& way, Material& m) {
  way.list(m.name);
  way.list(m.reflectance);
  way.list(m.emission);
  way.value(m.two_sided);
  way.value(m.blocker);
}

template <class Way>
void pass(Way& way, Scene& s) {
  way.value(s.bands);
  way.value(s.z_up);
  way.list(s.vertices);
  way.resize(s.materials);
  for (Material& m : s.materials) pass(way, m);
  way.list(s.corners);
  way.list(s.material);
  way.list(s.face);
  way.list(s.flags);
  way.list(s.emission);
  way.list(s.reflectance);
  way.resize(s.diagnostics);
  for (std::string& text : s.diagnostics) way.list(text);
}

template <class T>
void broadcast_any(Comm& comm, T& what) {
  if (comm.alone()) return;
  Bytes bytes;
  if (comm.rank() == 0) {
    Writer writer(bytes);
    pass(writer, what);
  }
  comm.broadcast(bytes);
  if (comm.rank() == 0) return;
  Reader reader(bytes);
  pass(reader, what);
}

}  // namespace

void broadcast(Comm& comm, Scene& scene) { broadcast_any(comm, scene); }
void broadcast(Comm& comm, Material& material) { broadcast_any(comm, material); }

}  // namespace hrad
