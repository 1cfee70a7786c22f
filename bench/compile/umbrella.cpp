#include <dalembert/dalembert.h>
