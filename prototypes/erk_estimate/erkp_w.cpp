#include "erkp_null.h"
int main(){ for(int p:{3,4,6}){ for(auto&w:nul::exact(p,false)){ printf("p=%d dims\n",p); for(int i=0;i<13;++i)printf("%.17g, ",w[i]); printf("\n"); } } }
