/* Loaded in front of the C library: makes one call that writes files fail, the one of the number in
 * HRAD_FAIL_CALL (from 1), or all from there on with HRAD_FAIL_EVER=1, with the error number in
 * HRAD_FAIL_ERRNO (0: a short write). Only calls on files in HRAD_FAIL_FOLDER count, and on this
 * folder. At its end the process writes into HRAD_FAIL_REPORT how many such calls there were and,
 * in the next line, which one was the first to fail: "fsync a file", "fsync the folder".
 *
 * Besides, calls of the name HRAD_FAIL_ALWAYS fail there, reading ones too, with the error number
 * in HRAD_FAIL_ALWAYS_ERRNO; these are not counted. */
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

enum kind { of_no_interest, is_file, is_folder, is_read };

static int calls;
static char watched[4096];
static char first_failed[64];

static int is_watched_path(const char* path) {
  const char* folder = getenv("HRAD_FAIL_FOLDER");
  return folder && path && strncmp(path, folder, strlen(folder)) == 0;
}

/* What is opened so: files are written, folders synchronised; what is read alone does not count. */
static enum kind kind_of(const char* path, int flags) {
  if (!is_watched_path(path)) return of_no_interest;
  if (flags & O_DIRECTORY) return is_folder;
  return (flags & O_ACCMODE) != O_RDONLY ? is_file : is_read;
}

static enum kind watched_kind(int file) {
  return file >= 0 && file < (int)sizeof watched ? (enum kind)watched[file] : of_no_interest;
}

static int always(const char* name) {
  const char *wanted = getenv("HRAD_FAIL_ALWAYS"), *error = getenv("HRAD_FAIL_ALWAYS_ERRNO");
  return wanted && error && strcmp(wanted, name) == 0 ? atoi(error) : 0;
}

/* Counts a call: 0: let it through; else the error, -1 for a short write. */
static int failure(const char* name, enum kind kind) {
  const char *number = getenv("HRAD_FAIL_CALL"), *ever = getenv("HRAD_FAIL_EVER"),
             *error = getenv("HRAD_FAIL_ERRNO");
  const int wanted = number ? atoi(number) : 0, known = always(name);
  if (known) return known;
  ++calls;
  if (wanted == 0 || calls < wanted || (calls > wanted && !(ever && *ever == '1'))) return 0;
  if (!*first_failed)
    snprintf(first_failed, sizeof first_failed, "%s %s", name,
             kind == is_folder ? "the folder" : "a file");
  return error && atoi(error) > 0 ? atoi(error) : -1;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define FAIL_OR(name, kind, call)        \
  const int error = failure(name, kind); \
  if (error > 0) {                       \
    errno = error;                       \
    return -1;                           \
  }                                      \
  return call

int open(const char* path, int flags, ...) {
  va_list arguments;
  const enum kind kind = kind_of(path, flags);
  int mode, file;
  va_start(arguments, flags);
  mode = flags & O_CREAT ? va_arg(arguments, int) : 0;
  va_end(arguments);
  if (kind == is_file || kind == is_folder) {
    const int error = failure("open", kind);
    if (error > 0) {
      errno = error;
      return -1;
    }
  }
  file = NEXT(open)(path, flags, mode);
  if (file >= 0 && file < (int)sizeof watched) watched[file] = (char)kind;
  return file;
}

ssize_t write(int file, const void* data, size_t size) {
  if (watched_kind(file) != is_file) return NEXT(write)(file, data, size);
  {
    const int error = failure("write", is_file);
    if (error > 0) {
      errno = error;
      return -1;
    }
    return NEXT(write)(file, data, error < 0 && size > 1 ? size / 2 : size);
  }
}

ssize_t pwrite(int file, const void* data, size_t size, off_t offset) {
  if (watched_kind(file) != is_file) return NEXT(pwrite)(file, data, size, offset);
  {
    const int error = failure("pwrite", is_file);
    if (error > 0) {
      errno = error;
      return -1;
    }
    return NEXT(pwrite)(file, data, error < 0 && size > 1 ? size / 2 : size, offset);
  }
}

ssize_t read(int file, void* data, size_t size) {
  const int error = watched_kind(file) == of_no_interest ? 0 : always("read");
  if (error == 0) return NEXT(read)(file, data, size);
  errno = error;
  return -1;
}

ssize_t pread(int file, void* data, size_t size, off_t offset) {
  const int error = watched_kind(file) == of_no_interest ? 0 : always("pread");
  if (error == 0) return NEXT(pread)(file, data, size, offset);
  errno = error;
  return -1;
}

int fchmod(int file, mode_t mode) {
  if (watched_kind(file) != is_file) return NEXT(fchmod)(file, mode);
  { FAIL_OR("fchmod", is_file, NEXT(fchmod)(file, mode)); }
}

int fsync(int file) {
  const enum kind kind = watched_kind(file);
  if (kind == of_no_interest || kind == is_read) return NEXT(fsync)(file);
  { FAIL_OR("fsync", kind, NEXT(fsync)(file)); }
}

int close(int file) {
  const enum kind kind = watched_kind(file);
  if (file >= 0 && file < (int)sizeof watched) watched[file] = 0;
  if (kind == of_no_interest || kind == is_read) return NEXT(close)(file);
  {
    /* As the system does: the file is closed all the same. */
    const int error = failure("close", kind), closed = NEXT(close)(file);
    if (error <= 0) return closed;
    errno = error;
    return -1;
  }
}

int link(const char* from, const char* to) {
  if (!is_watched_path(from)) return NEXT(link)(from, to);
  { FAIL_OR("link", is_file, NEXT(link)(from, to)); }
}

int rename(const char* from, const char* to) {
  if (!is_watched_path(from)) return NEXT(rename)(from, to);
  { FAIL_OR("rename", is_file, NEXT(rename)(from, to)); }
}

int flock(int file, int operation) {
  if (watched_kind(file) != is_file) return NEXT(flock)(file, operation);
  { FAIL_OR("flock", is_file, NEXT(flock)(file, operation)); }
}

__attribute__((destructor)) static void report(void) {
  const char* path = getenv("HRAD_FAIL_REPORT");
  FILE* file = path ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%d\n%s\n", calls, first_failed);
  fclose(file);
}
