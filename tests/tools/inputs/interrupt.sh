#!/bin/sh
# interrupt.sh COMMAND...: runs the command, whose standard input stays open, interrupts it, and gives its status.
mkfifo "$1" || exit 99
fifo=$1
shift
"$@" < "$fifo" &
process=$!
exec 3> "$fifo"
sleep 0.5
kill -INT $process
wait $process
