# SPDX-License-Identifier: MIT
cp -r ../tsubu/include .
${CXX:-c++} -std=c++20 -Iinclude main.cpp -o mine
