#!/bin/sh
# status.sh N COMMAND...: runs the command and succeeds where it ends with status N.
expected=$1
shift
"$@"
status=$?
[ "$status" = "$expected" ] && exit 0
echo "status $status instead of $expected: $*" >&2
exit 1
