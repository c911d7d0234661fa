/* Loaded in front of the C library: makes one call that writes files fail, the one of the number in
 * HRAD_FAIL_CALL (from 1), or all from there on with HRAD_FAIL_EVER=1, with the error number in
 * HRAD_FAIL_ERRNO (0: a short write). Only calls on files in HRAD_FAIL_FOLDER count. At its end the
 * process writes how many such calls there were into HRAD_FAIL_REPORT. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static int calls;
static char watched[4096];

static int is_watched_path(const char *path) {
  const char *folder = getenv("HRAD_FAIL_FOLDER");
  return folder && path && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_watched(int file) { return file >= 0 && file < (int)sizeof watched && watched[file]; }

/* Counts a call: 0: let it through; else the error, -1 for a short write. */
static int failure(void) {
  const char *number = getenv("HRAD_FAIL_CALL"), *ever = getenv("HRAD_FAIL_EVER"),
             *error = getenv("HRAD_FAIL_ERRNO");
  const int wanted = number ? atoi(number) : 0;
  ++calls;
  if (wanted == 0 || calls < wanted || (calls > wanted && !(ever && *ever == '1'))) return 0;
  return error && atoi(error) > 0 ? atoi(error) : -1;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define FAIL_OR(call)                      \
  const int error = failure();             \
  if (error > 0) {                         \
    errno = error;                         \
    return -1;                             \
  }                                        \
  return call

int open(const char *path, int flags, ...) {
  va_list arguments;
  int mode, file;
  va_start(arguments, flags);
  mode = flags & O_CREAT ? va_arg(arguments, int) : 0;
  va_end(arguments);
  if (is_watched_path(path) && (flags & O_ACCMODE) != O_RDONLY) {
    const int error = failure();
    if (error > 0) {
      errno = error;
      return -1;
    }
  }
  file = NEXT(open)(path, flags, mode);
  if (file >= 0 && file < (int)sizeof watched)
    watched[file] = is_watched_path(path) && (flags & O_ACCMODE) != O_RDONLY;
  return file;
}

ssize_t write(int file, const void *data, size_t size) {
  if (!is_watched(file)) return NEXT(write)(file, data, size);
  {
    const int error = failure();
    if (error > 0) {
      errno = error;
      return -1;
    }
    return NEXT(write)(file, data, error < 0 && size > 1 ? size / 2 : size);
  }
}

ssize_t pwrite(int file, const void *data, size_t size, off_t offset) {
  if (!is_watched(file)) return NEXT(pwrite)(file, data, size, offset);
  {
    const int error = failure();
    if (error > 0) {
      errno = error;
      return -1;
    }
    return NEXT(pwrite)(file, data, error < 0 && size > 1 ? size / 2 : size, offset);
  }
}

int fsync(int file) {
  if (!is_watched(file)) return NEXT(fsync)(file);
  { FAIL_OR(NEXT(fsync)(file)); }
}

int close(int file) {
  const int counts = is_watched(file);
  if (file >= 0 && file < (int)sizeof watched) watched[file] = 0;
  if (!counts) return NEXT(close)(file);
  {
    /* As the system does: the file is closed all the same. */
    const int error = failure(), closed = NEXT(close)(file);
    if (error <= 0) return closed;
    errno = error;
    return -1;
  }
}

int link(const char *from, const char *to) {
  if (!is_watched_path(from)) return NEXT(link)(from, to);
  { FAIL_OR(NEXT(link)(from, to)); }
}

int rename(const char *from, const char *to) {
  if (!is_watched_path(from)) return NEXT(rename)(from, to);
  { FAIL_OR(NEXT(rename)(from, to)); }
}

int flock(int file, int operation) {
  if (!is_watched(file)) return NEXT(flock)(file, operation);
  { FAIL_OR(NEXT(flock)(file, operation)); }
}

__attribute__((destructor)) static void report(void) {
  const char *path = getenv("HRAD_FAIL_REPORT");
  FILE *file = path ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%d\n", calls);
  fclose(file);
}
