#!/bin/sh
IFS= read -r line
kill -SEGV $$
