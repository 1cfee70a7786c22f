#pragma once

/// For a private header's namespace, `namespace DALEMBERT_HIDDEN dalembert {`: what it declares is no symbol
/// of the shared library.
#if defined(__GNUC__)
#define DALEMBERT_HIDDEN [[gnu::visibility("hidden")]]
#else
#define DALEMBERT_HIDDEN
#endif
