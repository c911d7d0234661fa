/* Whether a sanitizer watches this program: HRAD_TEST_ADDRESSES, HRAD_TEST_THREADS are 1 or 0. GCC
 * and clang tell it in different words. */
#ifndef HRAD_TESTS_SANITIZED_H
#define HRAD_TESTS_SANITIZED_H

#if defined(__has_feature)
#define HRAD_TEST_FEATURE(feature) __has_feature(feature)
#else
#define HRAD_TEST_FEATURE(feature) 0
#endif

#if defined(__SANITIZE_ADDRESS__) || HRAD_TEST_FEATURE(address_sanitizer)
#define HRAD_TEST_ADDRESSES 1
#else
#define HRAD_TEST_ADDRESSES 0
#endif
#if defined(__SANITIZE_THREAD__) || HRAD_TEST_FEATURE(thread_sanitizer)
#define HRAD_TEST_THREADS 1
#else
#define HRAD_TEST_THREADS 0
#endif

#endif
