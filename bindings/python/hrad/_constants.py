"""The constants of hrad.h, under their names less HRAD_."""

VERSION_MAJOR = 0
VERSION_MINOR = 1
VERSION_PATCH = 0

# Statuses: 0 done, positive a normal event, negative an error.
OK = 0
NOT_CONVERGED = 1  # the result is usable, the promise of accuracy is not kept
STOPPED = 2  # request_stop or the progress function asked for it
ERROR_ARGUMENT = -1
ERROR_STATE = -2
ERROR_MEMORY = -3
ERROR_FILE = -4
ERROR_FORMAT = -5
ERROR_SCENE = -6
ERROR_MPI = -7
ERROR_UNSUPPORTED = -8
ERROR_INTERNAL = -9

# Levels of messages.
LOG_ERROR = 0
LOG_WARNING = 1
LOG_INFO = 2
LOG_DEBUG = 3

# Types of parameters.
PARAM_INT = 0
PARAM_DOUBLE = 1
PARAM_TEXT = 2

# Flags of materials.
TWO_SIDED = 1
BLOCKER = 2

# Flags of patches.
PATCH_DROPPED = 1
PATCH_TWO_SIDED = 2
PATCH_BLOCKER = 4

# Ranks that can be planned for.
MOST_RANKS = 65536

# Quantities of queries, in W/m2.
RADIOSITY = 0
IRRADIANCE = 1
EMISSION = 2
NET_FLUX = 3

# Sides of patches.
FRONT = 0
BACK = 1
